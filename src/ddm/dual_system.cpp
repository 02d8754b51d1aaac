#include "ddm/dual_system.hpp"

#include "base/parallel.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

constexpr double worth_threads = 2e6;  // multiplications of one product, for threads to be worth their start

// Both over the contact nodes of a part, dimensionless.
struct ContactStiffness {
  SparseMatrix sharing;  // B W^-1 B^T, full
  MatX stiffness;        // B W^-1 S W^-1 B^T, full
};

// S = K_cc - K_ci K_ii^-1 K_ic, applied to Y = W^-1 B^T: the second term is Z K_ii^-1 Z^T with Z = Y^T K_ci, which a
// factorisation of K_ii with Z for its border gives.
ContactStiffness contact_stiffness(const SaddlePointSystem& s) {
  const Eigen::Index n = s.K.cols(), m = s.B.rows();
  const SparseMatrix B = s.row_scale.cwiseInverse().asDiagonal() * s.B;
  const double stiffness = s.K.diagonal().mean() / s.stiffness_scale;
  VecX share = VecX::Zero(n);  // W^-1, on contact nodes
  std::vector<char> left_out = s.constraints.fixed;
  for (Eigen::Index i = 0; i < n; ++i) {
    double sum = 0, size = 0;
    for (SparseMatrix::InnerIterator it(s.B, i); it; ++it) {
      sum += it.value();
      size += std::abs(it.value());
    }
    if (left_out[i] || size == 0) continue;
    share(i) = 1 / (stiffness * std::max(std::abs(sum), 0.1 * size));
    left_out[i] = 1;
  }
  const SparseMatrix Y = share.asDiagonal() * SparseMatrix(B.transpose());
  SparseMatrix KY = (s.K.selfadjointView<Eigen::Lower>() * Y) / s.stiffness_scale;
  ContactStiffness found{.sharing = B * Y, .stiffness = MatX(SparseMatrix(Y.transpose()) * KY)};

  SaddlePointSystem inner;
  inner.K = s.K;
  inner.stiffness_scale = s.stiffness_scale;
  inner.B = KY.transpose();
  inner.row_scale = VecX::Ones(m);
  for (const std::vector<int>& springs : {std::vector<int>{}, s.grounded}) {  // few contact nodes hold no part
    BorderedSystem bordered = bordered_system(inner, left_out, springs);
    BorderedCholesky factor(std::move(bordered.matrix), bordered.blocks);
    if (factor.failed_at() >= 0) continue;
    const MatX compliance = factor.take_border_compliance();
    found.stiffness -= MatX(compliance.topLeftCorner(m, m).selfadjointView<Eigen::Lower>());
    break;
  }
  return found;
}

}  // namespace

DualSystem::DualSystem(const SaddlePointSystem& s) {
  const Eigen::Index m = s.B.rows(), springs = s.grounded.size();
  load.r = VecX::Zero(m);
  if (ranks().rank() == 0) load.r = -(s.g - s.B * s.constraints.value).cwiseQuotient(s.row_scale);
  load.h = VecX::Zero(springs);
  std::vector<Substructure> all = substructures(s, ranks().rank(), ranks().count());
  std::vector<std::optional<Part>> parts(all.size());
  std::vector<SparseMatrix> shared(all.size());
  for_each_index(all.size(), solver_threads(), [&](std::size_t k) {
    Substructure& own = all[k];
    BodyGroup group(own.system, std::vector<char>(own.unknowns.size(), 1));
    group.compliance.resize(0, 0);
    ContactStiffness contact = contact_stiffness(own.system);
    shared[k] = std::move(contact.sharing);
    parts[k] = Part{std::move(own.unknowns), std::move(own.rows),         std::move(own.springs), {},
                    std::move(group),        std::move(contact.stiffness)};
    own.system = {};
  });

  Triplets of_H, of_sharing;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    Part& part = *parts[k];
    if (part.group.failed_at >= 0) {
      failed_at = part.unknowns[part.group.failed_at];
      break;
    }
    load.r(part.rows) += part.group.load.response;
    load.h(part.springs) = part.group.load.work;
    load.parts.push_back(std::move(part.group.load));
    for (std::size_t a = 0; a < part.rows.size(); ++a)
      for (std::size_t j = 0; j < part.springs.size(); ++j)
        of_H.emplace_back(part.rows[a], part.springs[j], part.group.H(a, j));
    for (int j = 0; j < shared[k].cols(); ++j)
      for (SparseMatrix::InnerIterator it(shared[k], j); it; ++it)
        if (it.row() >= j) of_sharing.emplace_back(part.rows[it.row()], part.rows[j], it.value());
    parts_.push_back(std::move(part));
  }
  failed_at = ranks().largest(failed_at);
  if (failed_at >= 0) return;
  sum_over_ranks(load);
  deal_rows(m);
  of_H = ranks().of_all(std::move(of_H));
  SparseRows all_H(m, springs);
  all_H.setFromTriplets(of_H.begin(), of_H.end());
  H = rows_->own(all_H);
  of_sharing = ranks().of_all(std::move(of_sharing));
  sharing.resize(m, m);
  sharing.setFromTriplets(of_sharing.begin(), of_sharing.end());
}

void DualSystem::deal_rows(Eigen::Index m) {
  std::vector<int> seen;
  for (const Part& part : parts_) seen.insert(seen.end(), part.rows.begin(), part.rows.end());
  std::ranges::sort(seen);
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  rows_ = ranks().deal(m, seen);
  for (Part& part : parts_) part.places = rows_->places(part.rows);
}

void DualSystem::sum_over_ranks(Answer& answer) {
  ranks().sum(answer.r.data(), answer.r.size());
  ranks().sum(answer.h.data(), answer.h.size());
}

namespace {

// The sum over the parts of a matrix times the entries of x in their places.
template <typename Parts, typename Matrix>
VecX sum_of_products(const Parts& parts, const VecX& x, Matrix matrix) {
  std::vector<VecX> products(parts.size());
  double work = 0;
  for (const auto& part : parts) work += double(part.rows.size()) * double(part.rows.size());
  for_each_index(parts.size(), work > worth_threads ? solver_threads() : 1,
                 [&](std::size_t k) { products[k].noalias() = matrix(parts[k]) * VecX(x(parts[k].places)); });
  VecX sum = VecX::Zero(x.size());
  for (std::size_t k = 0; k < parts.size(); ++k) sum(parts[k].places) += products[k];
  return sum;
}

}  // namespace

VecX DualSystem::multiply(const VecX& lambda) const {
  return rows_->sum_of_seen(
      sum_of_products(parts_, rows_->seen(lambda), [](const Part& part) -> const MatX& { return part.group.C; }));
}

VecX DualSystem::closing(const VecX& lambda, const VecX& mu) const {
  return rows_->whole(multiply(rows_->own(lambda)) + H * mu);
}

VecX DualSystem::multiply_stiffness(const VecX& x) const {
  return rows_->sum_of_seen(
      sum_of_products(parts_, rows_->seen(x), [](const Part& part) -> const MatX& { return part.stiffness; }));
}

DualSystem::Answer DualSystem::answer(const VecX& force) const {
  Answer all{.parts = std::vector<BodyGroup::Answer>(parts_.size()),
             .r = VecX::Zero(sharing.rows()),
             .h = VecX::Zero(H.cols())};
  for_each_index(parts_.size(), solver_threads(),
                 [&](std::size_t k) { all.parts[k] = parts_[k].group.answer(force(parts_[k].unknowns)); });
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    all.r(parts_[k].rows) += all.parts[k].response;
    all.h(parts_[k].springs) = all.parts[k].work;
  }
  sum_over_ranks(all);
  return all;
}

void DualSystem::add_displacements(const Answer& forces, const VecX& lambda, const VecX& mu, VecX& u) const {
  VecX added = VecX::Zero(u.size());
  for_each_index(parts_.size(), solver_threads(), [&](std::size_t k) {
    const Part& part = parts_[k];
    VecX own = VecX::Zero(part.unknowns.size());
    part.group.add_displacements(forces.parts[k], lambda(part.rows), mu(part.springs), own);
    added(part.unknowns) = own;
  });
  ranks().sum(added.data(), added.size());
  u += added;
}

}  // namespace mortise
