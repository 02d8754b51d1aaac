#include "ddm/closed_rows.hpp"

#include <cmath>
#include <limits>

#include "base/columns.hpp"
#include "solve/contact_rows.hpp"

namespace mortise {
namespace {

// Of a motion's own diagonal of the coarse problem: a pivot below it is round-off, and so is what a motion does to the
// rows.
constexpr double rigid_limit = 1e-9;
// A free motion's pivot is 1e-3 rigid_limit over the square of its spring's part in the motion: parts down to 1e-4.
constexpr double small_pivot = 1e-4;
constexpr double dependent_limit = 1e-13;  // likewise of a row's
constexpr double of_one_row = 1e-2;        // a single multiplier's error that counts as much as one of all in energy
constexpr double negligible_work = 1e-5;   // of its terms
constexpr double work_round_off = 1e-12;   // of the largest terms of any motion

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

SparseMatrix sum_of_ranks(SparseMatrix A) {
  if (ranks().count() == 1) return A;
  Triplets entries;
  for (int j = 0; j < A.cols(); ++j)
    for (SparseMatrix::InnerIterator it(A, j); it; ++it) entries.emplace_back(int(it.row()), j, it.value());
  entries = ranks().of_all(std::move(entries));
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

// What own rows of H under lambda do at most on any motion of each motion's bodies, s.
VecX most_work(const SparseMatrix& H, const VecX& lambda) {
  VecX most = VecX::Zero(H.rows()), sum = VecX::Zero(H.cols());
  for (int k = 0; k < H.cols(); ++k)
    for (SparseMatrix::InnerIterator it(H, k); it; ++it)
      most(it.row()) = std::max(most(it.row()), std::abs(it.value()));
  for (int k = 0; k < H.cols(); ++k)
    for (SparseMatrix::InnerIterator it(H, k); it; ++it) sum(k) += most(it.row()) * std::abs(lambda(it.row()));
  ranks().sum(sum.data(), sum.size());
  return sum;
}

}  // namespace

ClosedRows::ClosedRows(const DualSystem& system, const std::vector<char>& closed)
    : system_(system), rows_(system.rows()), of_parts_(system.closed_of_parts(closed)) {
  share_jumps(closed);
  if (dependent_row >= 0) return;
  hold_motions();
  if (system.slender.empty()) return;
  slender_.emplace(system.slender, closed);
  VecX compact = VecX::Ones(Eigen::Index(closed.size()));
  compact(system.slender.rows).setZero();
  compact_ = rows_.own(compact);
}

// Open rows keep their diagonal, which nothing reaches.
void ClosedRows::share_jumps(const std::vector<char>& flags) {
  SparseMatrix sharing = system_.sharing;
  const VecX closed = ones_and_zeros(flags);
  for (int j = 0; j < sharing.cols(); ++j)
    for (SparseMatrix::InnerIterator it(sharing, j); it; ++it)
      if (it.row() != j) it.valueRef() *= closed(it.row()) * closed(j);
  const VecX size = sharing.diagonal();
  closed_ = rows_.own(closed);
  weights_ = closed_.cwiseQuotient(rows_.own(size));
  sharing_.compute(sharing);
  if (size.size() == 0) return;
  const VecX pivots = sharing_.vectorD();
  for (Eigen::Index k = 0; k < pivots.size() && dependent_row < 0; ++k) {
    const int row = sharing_.permutationPinv().indices()(k);
    if (closed(row) > 0 && !(pivots(k) > dependent_limit * size(row))) dependent_row = row;
  }
}

// Springs of motions that E (s x s, of the rows and of springs held so far) leaves free, or none. A thousandth of the
// limit keeps pivots that should be zero from spoiling those after them, but makes the pivot of a free motion larger
// the less its spring moves in it. So if no pivot is round-off, the motions of small ones are looked at: the softest is
// one, and where several are soft they may be the same.
std::vector<int> ClosedRows::springs_left_free(const SparseMatrix& E, const VecX& size) {
  coarse_.compute(with_diagonal(E, 1e-3 * rigid_limit * size));
  const VecX pivots = coarse_.vectorD();
  std::vector<int> free, weak;
  for (Eigen::Index k = 0; k < pivots.size(); ++k) {
    const int spring = coarse_.permutationPinv().indices()(k);
    if (!(pivots(k) > rigid_limit * size(spring)))
      free.push_back(spring);
    else if (pivots(k) < small_pivot * size(spring))
      weak.push_back(spring);
  }
  if (!free.empty()) return free;
  double softest = rigid_limit;
  for (const int spring : weak) {
    const VecX motion = coarse_.solve(VecX(VecX::Unit(size.size(), spring) * size(spring))),
               parts = size.cwiseProduct(motion.cwiseAbs2());
    const double softness = motion.dot(E * motion) / parts.sum();
    if (!(softness < softest)) continue;
    softest = softness;
    Eigen::Index most;
    parts.maxCoeff(&most);
    free = {int(most)};
  }
  return free;
}

// H^T weights H, with a spring at each motion that it leaves free.
void ClosedRows::hold_motions() {
  const SparseMatrix& H = system_.H;
  const Eigen::Index springs = H.cols();
  free_motions.resize(springs, 0);
  if (springs == 0) return;
  const SparseMatrix E = sum_of_ranks(SparseMatrix(H.transpose()) * SparseMatrix(weights_.asDiagonal() * H));
  VecX size = E.diagonal();
  const double most = size.maxCoeff();
  for (double& of_motion : size)
    if (!(of_motion > rigid_limit * most)) of_motion = most > 0 ? most : 1;
  VecX held = VecX::Zero(springs);
  for (std::vector<int> free; !(free = springs_left_free(with_diagonal(E, held), size)).empty();) {
    free_.insert(free_.end(), free.begin(), free.end());
    held(free) = size(free);
  }
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
  for (int pass = 0; pass < 2; ++pass) lambda += weights_.cwiseProduct(system_.H * coarse(h - resultants(lambda)));
  return lambda;
}

// Those that leave least of a residual, in the norm of the weights.
VecX ClosedRows::motions(const VecX& residual) const { return coarse(resultants(weights_.cwiseProduct(residual))); }

// This projection, and its transpose below, twice: once leaves round-off of what the stiffest parts do in the way of
// the softest ones.
VecX ClosedRows::without_motions(VecX residual) const {
  for (int pass = 0; pass < 2; ++pass) residual -= on_closed(system_.H * motions(residual));
  return residual;
}

VecX ClosedRows::without_resultants(VecX lambda) const {
  for (int pass = 0; pass < 2; ++pass) lambda -= weights_.cwiseProduct(system_.H * coarse(resultants(lambda)));
  return lambda;
}

// What lambda does to the motions, s.
VecX ClosedRows::resultants(const VecX& lambda) const {
  VecX found = system_.H.transpose() * lambda;
  ranks().sum(found.data(), found.size());
  return found;
}

// A^-1 of a jump of the rows.
VecX ClosedRows::unshared(const VecX& jump) const { return on_closed(rows_.own(sharing_.solve(rows_.whole(jump)))); }

// Of a jump, the pressures by the parts' stiffness.
VecX ClosedRows::stiffened(const VecX& jump) const {
  return unshared(on_closed(system_.multiply_stiffness(unshared(jump), of_parts_)));
}

VecX ClosedRows::precondition(const VecX& residual) const {
  if (!slender_) return stiffened(residual);
  return compact_.cwiseProduct(stiffened(compact_.cwiseProduct(residual))) +
         rows_.own(slender_->multiply(rows_.whole(residual)));
}

void ClosedRows::solve(const DualSystem::Forces& forces, IterationMonitor& monitor, DualSolution& x) const {
  const VecX gaps = rows_.own(forces.r), response = rows_.own(forces.response);
  VecX lambda = balanced(rows_.own(x.lambda), forces.h), C_lambda = on_closed(system_.multiply(lambda, of_parts_));
  VecX r = without_motions(on_closed(gaps - C_lambda)), z = without_resultants(precondition(r)), p = z;
  double rz = rows_.dot(r, z);
  const auto residuals = [&] {
    const double terms = largest(rows_.largest(C_lambda), rows_.largest(gaps)),
                 size = system_.size(rows_.largest(on_closed(gaps - C_lambda)), terms), left = rows_.largest(r);
    // Where motions close all gaps that are closed, round-off of them is left, and no pressure to compare with its own.
    if (left <= std::numeric_limits<double>::epsilon() * size) return Residuals{.kinematic = 0, .force = 0};
    const double energy = forces.energy - 2 * rows_.dot(response, lambda) + rows_.dot(lambda, C_lambda);
    return Residuals{.kinematic = fraction(left, size),
                     .force = largest(std::sqrt(fraction(std::abs(rz), std::abs(energy))),
                                      of_one_row * fraction(rows_.largest(z), rows_.largest(lambda)))};
  };
  while (monitor.go_on(residuals(), std::sqrt(std::abs(rz)))) {
    const VecX Cp = on_closed(system_.multiply(p, of_parts_));
    const double alpha = rz / rows_.dot(p, Cp), before = rz;
    lambda += alpha * p;
    C_lambda += alpha * Cp;
    r -= alpha * without_motions(Cp);
    z = without_resultants(precondition(r));
    rz = rows_.dot(r, z);
    p = z + rz / before * p;
  }
  x.mu = motions(on_closed(gaps - C_lambda));
  x.lambda = rows_.whole(lambda);
}

VecX ClosedRows::driven_motion(const VecX& h, const VecX& lambda) const {
  VecX driven = VecX::Zero(h.size());
  if (free_.empty()) return driven;
  const VecX work = h - system_.resultants(lambda), terms = system_.work_terms(h, lambda);
  const VecX noise = normal_noise * most_work(system_.H, rows_.own(lambda));
  const double round_off = work_round_off * largest_entry(terms);
  for (const auto& motion : free_motions.colwise())
    if (std::abs(motion.dot(work)) > std::max({negligible_work * motion.cwiseAbs().dot(terms),
                                               motion.cwiseAbs().dot(noise), round_off * largest_entry(motion)}))
      driven += motion.dot(work) * motion;
  return driven;
}

}  // namespace mortise
