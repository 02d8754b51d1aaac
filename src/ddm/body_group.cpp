#include "ddm/body_group.hpp"

#include "solve/bordered_system.hpp"

namespace mortise {
namespace {

// Whether B and the loads differ on the unknowns that are not left out.
bool differ(const SaddlePointSystem& s, const std::vector<char>& left_out) {
  if (!s.loads) return false;
  const SparseMatrix difference = s.B - *s.loads;
  for (Eigen::Index j = 0; j < difference.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(difference, j); it; ++it)
      if (!left_out[std::size_t(j)] && it.value() != 0) return true;
  return false;
}

SparseMatrix below(const SparseMatrix& top, const SparseMatrix& bottom) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const SparseMatrix* part : {&top, &bottom})
    for (Eigen::Index j = 0; j < part->outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(*part, j); it; ++it)
        entries.emplace_back(int(it.row()) + (part == &bottom ? int(top.rows()) : 0), int(j), it.value());
  SparseMatrix both(top.rows() + bottom.rows(), top.cols());
  both.setFromTriplets(entries.begin(), entries.end());
  return both;
}

}  // namespace

BodyGroup::BodyGroup(const SaddlePointSystem& s, const std::vector<char>& member) {
  std::vector<char> left_out = s.fixed;
  for (std::size_t i = 0; i < member.size(); ++i) left_out[i] = left_out[i] || !member[i];
  std::vector<int> grounded;
  for (const int i : s.grounded)
    if (member[std::size_t(i)]) grounded.push_back(i);

  // The border measures by B and loads by the other rows, where they are not the same for this group.
  const Eigen::Index m = s.B.rows();
  const bool both = differ(s, left_out);
  const SparseMatrix rows = both ? below(s.B, *s.loads) : s.B;
  VecX scale(rows.rows());
  scale << s.row_scale, s.row_scale.head(rows.rows() - m);
  BorderedSystem system = bordered_system({s.K, rows, left_out, s.stiffness_scale, scale, grounded});
  free_ = std::move(system.free);
  factor_ = std::make_unique<BorderedCholesky>(std::move(system.matrix), system.blocks);
  if (factor_->failed_at() >= 0) {
    failed_at = free_[std::min(std::size_t(factor_->failed_at()), free_.size() - 1)];
    return;
  }
  motions = Eigen::Index(grounded.size());
  unused_ = both ? m : 0;
  if (both) {
    C = factor_->border_compliance().block(m, 0, m, m).transpose();
  } else {
    compliance = factor_->border_compliance();
    C = compliance.topLeftCorner(m, m).selfadjointView<Eigen::Lower>();
  }
  H = factor_->border_compliance().bottomLeftCorner(motions, m).transpose();

  const VecX Ku = s.K.selfadjointView<Eigen::Lower>() * s.value;
  const VecX all = factor_->forward(on_free(s.f - Ku) / s.stiffness_scale);
  response = all.head(m);
  work = all.tail(motions);
}

void BodyGroup::add_displacements(const VecX& lambda, const VecX& mu, VecX& u) const {
  VecX border(unused_ + lambda.size() + mu.size());
  border << VecX::Zero(unused_), lambda, mu;
  add_from_free(factor_->backward(border), u);
}

void BodyGroup::refine(const VecX& unbalanced, VecX& u) {
  const VecX border = factor_->forward(on_free(unbalanced));
  add_from_free(factor_->backward(VecX::Zero(border.size())), u);
}

VecX BodyGroup::on_free(const VecX& v) const {
  VecX part(Eigen::Index(free_.size()));
  for (std::size_t i = 0; i < free_.size(); ++i) part(Eigen::Index(i)) = v(free_[i]);
  return part;
}

void BodyGroup::add_from_free(const VecX& part, VecX& u) const {
  for (std::size_t i = 0; i < free_.size(); ++i) u(free_[i]) += part(Eigen::Index(i));
}

}  // namespace mortise
