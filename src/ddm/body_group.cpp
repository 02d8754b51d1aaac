#include "ddm/body_group.hpp"

#include "solve/bordered_system.hpp"

namespace mortise {
BodyGroup::BodyGroup(const SaddlePointSystem& s, const std::vector<char>& member) {
  std::vector<char> left_out = s.fixed;
  for (std::size_t i = 0; i < member.size(); ++i) left_out[i] = left_out[i] || !member[i];
  std::vector<int> grounded;
  for (const int i : s.grounded)
    if (member[i]) grounded.push_back(i);

  BorderedSystem system = bordered_system({s.K, s.B, left_out, s.stiffness_scale, s.row_scale, grounded});
  free_ = std::move(system.free);
  factor_ = std::make_unique<BorderedCholesky>(std::move(system.matrix), system.blocks);
  if (factor_->failed_at() >= 0) {
    failed_at = free_[std::min(factor_->failed_at(), int(free_.size()) - 1)];
    return;
  }
  motions = grounded.size();
  const Eigen::Index m = s.B.rows();
  compliance = factor_->border_compliance();
  C = compliance.topLeftCorner(m, m).selfadjointView<Eigen::Lower>();
  H = compliance.bottomLeftCorner(motions, m).transpose();

  const VecX Ku = s.K.selfadjointView<Eigen::Lower>() * s.value;
  const VecX all = factor_->forward(on_free(s.f - Ku) / s.stiffness_scale);
  response = all.head(m);
  work = all.tail(motions);
}

void BodyGroup::add_displacements(const VecX& lambda, const VecX& mu, VecX& u) const {
  VecX border(lambda.size() + mu.size());
  border << lambda, mu;
  add_from_free(factor_->backward(border), u);
}

void BodyGroup::refine(const VecX& unbalanced, VecX& u) {
  const VecX border = factor_->forward(on_free(unbalanced));
  add_from_free(factor_->backward(VecX::Zero(border.size())), u);
}

VecX BodyGroup::on_free(const VecX& v) const {
  VecX part(free_.size());
  for (std::size_t i = 0; i < free_.size(); ++i) part(i) = v(free_[i]);
  return part;
}

void BodyGroup::add_from_free(const VecX& part, VecX& u) const {
  for (std::size_t i = 0; i < free_.size(); ++i) u(free_[i]) += part(i);
}

}  // namespace mortise
