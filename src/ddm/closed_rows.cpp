#include "ddm/closed_rows.hpp"

#include <cmath>

#include "base/columns.hpp"

namespace mortise {
namespace {

// Of a motion's own diagonal of the coarse problem: a pivot below it is round-off.
constexpr double rigid_limit = 1e-9;
constexpr double dependent_limit = 1e-13;  // likewise of a row's
constexpr double of_one_row = 1e-2;        // a single multiplier's error that counts as much as one of all in energy
constexpr double negligible_work = 1e-5;   // of its terms

VecX ones_and_zeros(const std::vector<char>& flags) {
  VecX v(flags.size());
  for (std::size_t i = 0; i < flags.size(); ++i) v(i) = flags[i] ? 1 : 0;
  return v;
}

SparseMatrix with_diagonal(const SparseMatrix& A, const VecX& added) {
  SparseMatrix D(A.rows(), A.cols());
  D.reserve(Eigen::VectorXi::Constant(A.cols(), 1));
  for (Eigen::Index k = 0; k < A.cols(); ++k) D.insert(k, k) = added(k);
  return A + D;
}

SparseMatrix with_identity_below(const SparseMatrix& A) {
  SparseRows below(A.rows() + A.cols(), A.cols());
  below.topRows(A.rows()) = A;
  SparseRows identity(A.cols(), A.cols());
  identity.setIdentity();
  below.bottomRows(A.cols()) = identity;
  return below;
}

}  // namespace

ClosedRows::ClosedRows(const DualSystem& system, const std::vector<char>& closed, const VecX& supports)
    : system_(system),
      supports_(supports),
      H_(supports.size() > 0 ? with_identity_below(system.H) : system.H),
      closed_(stacked(ones_and_zeros(closed), VecX::Ones(supports.size()))) {
  share_jumps();
  if (dependent_row < 0) hold_motions();
}

// Open rows keep their diagonal, which nothing reaches.
void ClosedRows::share_jumps() {
  SparseMatrix sharing = system_.sharing;
  for (int j = 0; j < sharing.cols(); ++j)
    for (SparseMatrix::InnerIterator it(sharing, j); it; ++it)
      if (it.row() != j) it.valueRef() *= closed_(it.row()) * closed_(j);
  const VecX size = sharing.diagonal();
  weights_ = stacked(closed_.head(size.size()).cwiseQuotient(size), supports_);
  sharing_.compute(sharing);
  if (size.size() == 0) return;
  const VecX pivots = sharing_.vectorD();
  for (Eigen::Index k = 0; k < pivots.size() && dependent_row < 0; ++k) {
    const int row = sharing_.permutationPinv().indices()(k);
    if (closed_(row) > 0 && !(pivots(k) > dependent_limit * size(row))) dependent_row = row;
  }
}

// H^T weights H, with a spring at each motion that it leaves free.
void ClosedRows::hold_motions() {
  const Eigen::Index springs = H_.cols();
  free_motions.resize(springs, 0);
  if (springs == 0) return;
  const SparseMatrix E = SparseMatrix(H_.transpose()) * SparseMatrix(weights_.asDiagonal() * H_);
  VecX size = E.diagonal();
  const double most = size.maxCoeff();
  for (double& of_motion : size)
    if (!(of_motion > rigid_limit * most)) of_motion = most > 0 ? most : 1;
  // A thousandth of the limit keeps pivots that should be zero from spoiling those after them.
  coarse_.compute(with_diagonal(E, 1e-3 * rigid_limit * size));
  const VecX pivots = coarse_.vectorD();
  for (Eigen::Index k = 0; k < springs; ++k) {
    const int spring = coarse_.permutationPinv().indices()(k);
    if (!(pivots(k) > rigid_limit * size(spring))) free_.push_back(spring);
  }
  VecX held = VecX::Zero(springs);
  held(free_) = size(free_);
  coarse_.compute(with_diagonal(E, held));
  MatX found(springs, Eigen::Index(free_.size()));
  for (std::size_t k = 0; k < free_.size(); ++k)
    found.col(k) = coarse_.solve(VecX(VecX::Unit(springs, free_[k]) * size(free_[k])));
  free_motions = told_apart(std::move(found));
}

VecX ClosedRows::coarse(VecX b) const {
  if (b.size() == 0) return b;
  b(free_).setZero();
  return coarse_.solve(b);
}

// lambda, changed on closed rows until the parts are in balance.
VecX ClosedRows::balanced(VecX lambda, const VecX& h) const {
  lambda = on_closed(lambda);
  for (int pass = 0; pass < 2; ++pass) lambda += weights_.cwiseProduct(H_ * coarse(h - H_.transpose() * lambda));
  return lambda;
}

// Those that leave least of a residual, in the norm of the weights.
VecX ClosedRows::motions(const VecX& residual) const {
  return coarse(H_.transpose() * weights_.cwiseProduct(residual));
}

// This projection, and its transpose below, twice: once leaves round-off of what the stiffest parts do in the way of
// the softest ones.
VecX ClosedRows::without_motions(VecX residual) const {
  for (int pass = 0; pass < 2; ++pass) residual -= on_closed(H_ * motions(residual));
  return residual;
}

VecX ClosedRows::without_resultants(VecX lambda) const {
  for (int pass = 0; pass < 2; ++pass) lambda -= weights_.cwiseProduct(H_ * coarse(H_.transpose() * lambda));
  return lambda;
}

VecX ClosedRows::multiply(const VecX& lambda) const {
  const Eigen::Index springs = supports_.size(), m = lambda.size() - springs;
  return stacked(system_.multiply(lambda.head(m)), lambda.tail(springs).cwiseQuotient(supports_));
}

VecX ClosedRows::precondition(const VecX& residual) const {
  const Eigen::Index springs = supports_.size(), m = residual.size() - springs;
  const VecX closed = closed_.head(m), jump = closed.cwiseProduct(sharing_.solve(VecX(residual.head(m))));
  return stacked(closed.cwiseProduct(sharing_.solve(closed.cwiseProduct(system_.multiply_stiffness(jump)))),
                 residual.tail(springs).cwiseProduct(supports_));
}

void ClosedRows::solve(const DualSystem::Forces& forces, IterationMonitor& monitor, DualSolution& x) const {
  const Eigen::Index springs = supports_.size(), m = forces.r.size();
  if (x.support.size() != springs) x.support = VecX::Zero(springs);
  const VecX gaps = stacked(forces.r, VecX::Zero(springs));
  VecX lambda = balanced(stacked(x.lambda, x.support), forces.h), C_lambda = multiply(lambda);
  VecX r = without_motions(on_closed(gaps - C_lambda)), z = without_resultants(precondition(r)), p = z;
  double rz = r.dot(z);
  const auto residuals = [&] {
    const double terms = largest(largest_entry(C_lambda), largest_entry(gaps)),
                 size = system_.size(largest_entry(on_closed(gaps - C_lambda)), terms),
                 energy = forces.energy - 2 * forces.response.dot(lambda.head(m)) + lambda.dot(C_lambda);
    return Residuals{.kinematic = fraction(largest_entry(r), size),
                     .force = largest(std::sqrt(fraction(std::abs(rz), std::abs(energy))),
                                      of_one_row * fraction(largest_entry(z), largest_entry(lambda)))};
  };
  while (monitor.go_on(residuals(), std::sqrt(std::abs(rz)))) {
    const VecX Cp = multiply(p);
    const double alpha = rz / p.dot(Cp), before = rz;
    lambda += alpha * p;
    C_lambda += alpha * Cp;
    r -= alpha * without_motions(on_closed(Cp));
    z = without_resultants(precondition(r));
    rz = r.dot(z);
    p = z + rz / before * p;
  }
  x.mu = motions(on_closed(gaps - C_lambda));
  x.lambda = lambda.head(m);
  x.support = lambda.tail(springs);
}

VecX ClosedRows::driven_motion(const VecX& h, const VecX& lambda) const {
  VecX driven = VecX::Zero(H_.cols());
  if (free_.empty()) return driven;
  const SparseMatrix Ht = H_.transpose();
  const VecX work = h - Ht * lambda, terms = h.cwiseAbs() + Ht.cwiseAbs() * lambda.cwiseAbs();
  for (const auto& motion : free_motions.colwise())
    if (std::abs(motion.dot(work)) > negligible_work * motion.cwiseAbs().dot(terms))
      driven += motion.dot(work) * motion;
  return driven;
}

}  // namespace mortise
