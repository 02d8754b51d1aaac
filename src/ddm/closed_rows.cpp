#include "ddm/closed_rows.hpp"

#include <cmath>
#include <limits>
#include <numeric>

#include "base/columns.hpp"
#include "ddm/solve_together.hpp"
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

// Column by column.
VecX dot(const MatX& a, const MatX& b) { return a.cwiseProduct(b).colwise().sum(); }

VecX largest_entries(const MatX& columns) {
  VecX found(columns.cols());
  for (Eigen::Index k = 0; k < found.size(); ++k) found(k) = largest_entry(columns.col(k));
  return found;
}

// What rows of H under lambda do at most on any motion of each motion's bodies, s.
VecX most_work(const SparseMatrix& H, const VecX& lambda) {
  VecX most = VecX::Zero(H.rows()), sum = VecX::Zero(H.cols());
  for (int k = 0; k < H.cols(); ++k)
    for (SparseMatrix::InnerIterator it(H, k); it; ++it)
      most(it.row()) = std::max(most(it.row()), std::abs(it.value()));
  for (int k = 0; k < H.cols(); ++k)
    for (SparseMatrix::InnerIterator it(H, k); it; ++it) sum(k) += most(it.row()) * std::abs(lambda(it.row()));
  return sum;
}

}  // namespace

ClosedRows::ClosedRows(const DualSystem& system, const std::vector<char>& closed)
    : system_(system), of_parts_(system.closed_of_parts(closed)) {
  share_jumps(closed);
  if (dependent_row >= 0) return;
  hold_motions();
  if (system.slender.empty()) return;
  slender_.emplace(system.slender, closed);
  compact_ = VecX::Ones(Eigen::Index(closed.size()));
  compact_(system.slender.rows).setZero();
}

// Open rows keep their diagonal, which nothing reaches.
void ClosedRows::share_jumps(const std::vector<char>& closed) {
  SparseMatrix sharing = system_.sharing;
  closed_ = ones_and_zeros(closed);
  for (int j = 0; j < sharing.cols(); ++j)
    for (SparseMatrix::InnerIterator it(sharing, j); it; ++it)
      if (it.row() != j) it.valueRef() *= closed_(it.row()) * closed_(j);
  const VecX size = sharing.diagonal();
  weights_ = closed_.cwiseQuotient(size);
  sharing_.compute(sharing);
  if (size.size() == 0) return;
  const VecX pivots = sharing_.vectorD();
  for (Eigen::Index k = 0; k < pivots.size() && dependent_row < 0; ++k) {
    const int row = sharing_.permutationPinv().indices()(k);
    if (closed[row] && !(pivots(k) > dependent_limit * size(row))) dependent_row = row;
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
  const SparseMatrix E = SparseMatrix(H.transpose()) * SparseMatrix(weights_.asDiagonal() * H);
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

MatX ClosedRows::coarse(MatX b) const {
  if (b.size() == 0) return b;
  b(free_, Eigen::all).setZero();
  return solve_together(coarse_, b);
}

// lambda, changed on closed rows until the parts are in balance.
MatX ClosedRows::balanced(MatX lambda, const MatX& h) const {
  lambda = on_closed(lambda);
  for (int pass = 0; pass < 2; ++pass)
    lambda += weights_.asDiagonal() * MatX(system_.H * coarse(h - system_.resultants(lambda)));
  return lambda;
}

// Those that leave least of a residual, in the norm of the weights.
MatX ClosedRows::motions(const MatX& residual) const {
  return coarse(system_.resultants(weights_.asDiagonal() * residual));
}

// This projection, and its transpose below, twice: once leaves round-off of what the stiffest parts do in the way of
// the softest ones.
MatX ClosedRows::without_motions(MatX residual) const {
  for (int pass = 0; pass < 2; ++pass) residual -= on_closed(system_.H * motions(residual));
  return residual;
}

MatX ClosedRows::without_resultants(MatX lambda) const {
  for (int pass = 0; pass < 2; ++pass)
    lambda -= weights_.asDiagonal() * MatX(system_.H * coarse(system_.resultants(lambda)));
  return lambda;
}

// A^-1 of a jump of the rows.
MatX ClosedRows::unshared(const MatX& jump) const { return on_closed(solve_together(sharing_, jump)); }

// Of a jump, the pressures by the parts' stiffness.
MatX ClosedRows::stiffened(const MatX& jump) const {
  return unshared(on_closed(system_.multiply_stiffness(unshared(jump), of_parts_)));
}

MatX ClosedRows::precondition(const MatX& residual) const {
  if (!slender_) return stiffened(residual);
  return compact_.asDiagonal() * stiffened(compact_.asDiagonal() * residual) + slender_->multiply(residual);
}

// Those that are iterated on, and what they are of.
struct ClosedRows::Columns {
  std::vector<int> of;
  MatX gaps, response, lambda, C_lambda, r, z, p;
  VecX energy, rz;

  void keep(const std::vector<int>& some) {
    for (MatX* columns : {&gaps, &response, &lambda, &C_lambda, &r, &z, &p})
      *columns = MatX((*columns)(Eigen::all, some));
    energy = VecX(energy(some));
    rz = VecX(rz(some));
    std::vector<int> kept;
    for (const int k : some) kept.push_back(of[k]);
    of = std::move(kept);
  }
};

std::vector<Residuals> ClosedRows::residuals(const Columns& at) const {
  const VecX C_lambda = largest_entries(at.C_lambda), gaps = largest_entries(at.gaps), r = largest_entries(at.r),
             moved = largest_entries(on_closed(at.gaps - at.C_lambda)), z = largest_entries(at.z),
             lambda = largest_entries(at.lambda),
             energy = at.energy - 2 * dot(at.response, at.lambda) + dot(at.lambda, at.C_lambda);
  std::vector<Residuals> all;
  for (Eigen::Index k = 0; k < r.size(); ++k) {
    const double size = system_.size(moved(k), largest(C_lambda(k), gaps(k)));
    // Where motions alone close the gaps, what pressures do is round-off of them as is what is left, and no measure of
    // it.
    if (largest(r(k), C_lambda(k)) <= std::numeric_limits<double>::epsilon() * size) {
      all.push_back({.kinematic = 0, .force = 0});
      continue;
    }
    all.push_back({.kinematic = fraction(r(k), size),
                   .force = largest(std::sqrt(fraction(std::abs(at.rz(k)), std::abs(energy(k)))),
                                    of_one_row * fraction(z(k), lambda(k)))});
  }
  return all;
}

void ClosedRows::solve(const DualSystem::Forces& forces, std::span<IterationMonitor> monitors, DualSolution& x) const {
  const Eigen::Index count = forces.r.cols();
  Columns at{.of = std::vector<int>(count),
             .gaps = forces.r,
             .response = forces.response,
             .lambda = balanced(x.lambda, forces.h),
             .C_lambda = {},
             .r = {},
             .z = {},
             .p = {},
             .energy = forces.energy,
             .rz = {}};
  std::iota(at.of.begin(), at.of.end(), 0);
  at.C_lambda = on_closed(system_.multiply(at.lambda, of_parts_));
  at.r = without_motions(on_closed(at.gaps - at.C_lambda));
  at.p = at.z = without_resultants(precondition(at.r));
  at.rz = dot(at.r, at.z);
  MatX left(at.gaps.rows(), count);
  while (true) {
    const std::vector<Residuals> found = residuals(at);
    std::vector<int> go_on;
    for (std::size_t k = 0; k < at.of.size(); ++k) {
      if (monitors[at.of[k]].go_on(found[k], std::sqrt(std::abs(at.rz(Eigen::Index(k)))))) {
        go_on.push_back(int(k));
        continue;
      }
      x.lambda.col(at.of[k]) = at.lambda.col(Eigen::Index(k));
      left.col(at.of[k]) = at.gaps.col(Eigen::Index(k)) - at.C_lambda.col(Eigen::Index(k));
    }
    if (go_on.empty()) break;
    if (go_on.size() < at.of.size()) at.keep(go_on);
    const MatX Cp = on_closed(system_.multiply(at.p, of_parts_));
    const VecX alpha = at.rz.cwiseQuotient(dot(at.p, Cp)), before = at.rz;
    at.lambda += at.p * alpha.asDiagonal();
    at.C_lambda += Cp * alpha.asDiagonal();
    at.r -= without_motions(Cp) * alpha.asDiagonal();
    at.z = without_resultants(precondition(at.r));
    at.rz = dot(at.r, at.z);
    at.p = at.z + at.p * at.rz.cwiseQuotient(before).asDiagonal();
  }
  x.mu = motions(on_closed(left));
}

VecX ClosedRows::driven_motion(const VecX& h, const VecX& lambda) const {
  VecX driven = VecX::Zero(h.size());
  if (free_.empty()) return driven;
  const VecX work = h - system_.resultants(lambda), terms = system_.work_terms(h, lambda);
  const VecX noise = normal_noise * most_work(system_.H, lambda);
  const double round_off = work_round_off * largest_entry(terms);
  for (const auto& motion : free_motions.colwise())
    if (std::abs(motion.dot(work)) > std::max({negligible_work * motion.cwiseAbs().dot(terms),
                                               motion.cwiseAbs().dot(noise), round_off * largest_entry(motion)}))
      driven += motion.dot(work) * motion;
  return driven;
}

}  // namespace mortise
