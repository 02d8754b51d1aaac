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
  diagonal = VecX::Zero(m);
  std::vector<Substructure> all = substructures(s);
  std::vector<std::optional<Part>> parts(all.size());
  std::vector<SparseMatrix> shared(all.size());
  for_each_index(all.size(), solver_threads(), [&](std::size_t k) {
    Substructure& own = all[k];
    BodyGroup group(own.system, std::vector<char>(own.unknowns.size(), 1));
    group.compliance.resize(0, 0);
    ContactStiffness contact = contact_stiffness(own.system);
    shared[k] = std::move(contact.sharing);
    parts[k] = Part{std::move(own.unknowns), std::move(own.rows), std::move(own.springs), std::move(group),
                    std::move(contact.stiffness)};
    own.system = {};
  });

  std::vector<Eigen::Triplet<double>> of_H, of_sharing;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    Part& part = *parts[k];
    if (part.group.failed_at >= 0) {
      failed_at = part.unknowns[part.group.failed_at];
      return;
    }
    diagonal(part.rows) += part.group.C.diagonal();
    load.parts.push_back(std::move(part.group.load));
    for (std::size_t a = 0; a < part.rows.size(); ++a)
      for (std::size_t j = 0; j < part.springs.size(); ++j)
        of_H.emplace_back(part.rows[a], part.springs[j], part.group.H(a, j));
    for (int j = 0; j < shared[k].cols(); ++j)
      for (SparseMatrix::InnerIterator it(shared[k], j); it; ++it)
        if (it.row() >= j) of_sharing.emplace_back(part.rows[it.row()], part.rows[j], it.value());
    parts_.push_back(std::move(part));
  }
  H.resize(m, springs);
  H.setFromTriplets(of_H.begin(), of_H.end());
  sharing.resize(m, m);
  sharing.setFromTriplets(of_sharing.begin(), of_sharing.end());
  add_up(load);
  load.r -= (s.g - s.B * s.constraints.value).cwiseQuotient(s.row_scale);
}

void DualSystem::add_up(Answer& answer) const {
  answer.response = VecX::Zero(H.rows());
  answer.h = VecX::Zero(H.cols());
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const BodyGroup::Answer& part = answer.parts[k];
    answer.response(parts_[k].rows) += part.response;
    answer.h(parts_[k].springs) = part.work;
    answer.energy += part.y.squaredNorm();
  }
  answer.r = answer.response;
}

namespace {

// The sum over the parts of a matrix times the entries of x on their rows.
template <typename Parts, typename Matrix>
VecX sum_of_products(const Parts& parts, const VecX& x, Matrix matrix) {
  std::vector<VecX> products(parts.size());
  double work = 0;
  for (const auto& part : parts) work += double(part.rows.size()) * double(part.rows.size());
  for_each_index(parts.size(), work > worth_threads ? solver_threads() : 1,
                 [&](std::size_t k) { products[k].noalias() = matrix(parts[k]) * VecX(x(parts[k].rows)); });
  VecX sum = VecX::Zero(x.size());
  for (std::size_t k = 0; k < parts.size(); ++k) sum(parts[k].rows) += products[k];
  return sum;
}

}  // namespace

VecX DualSystem::multiply(const VecX& lambda) const {
  return sum_of_products(parts_, lambda, [](const Part& part) -> const MatX& { return part.group.C; });
}

VecX DualSystem::multiply_stiffness(const VecX& x) const {
  return sum_of_products(parts_, x, [](const Part& part) -> const MatX& { return part.stiffness; });
}

DualSystem::Answer DualSystem::answer(const VecX& force) const {
  Answer all;
  all.parts.resize(parts_.size());
  for_each_index(parts_.size(), solver_threads(),
                 [&](std::size_t k) { all.parts[k] = parts_[k].group.answer(force(parts_[k].unknowns)); });
  add_up(all);
  return all;
}

void DualSystem::add_displacements(const Answer& forces, const VecX& lambda, const VecX& mu, VecX& u) const {
  for_each_index(parts_.size(), solver_threads(), [&](std::size_t k) {
    const Part& part = parts_[k];
    VecX own = u(part.unknowns);
    part.group.add_displacements(forces.parts[k], lambda(part.rows), mu(part.springs), own);
    u(part.unknowns) = own;
  });
}

}  // namespace mortise
