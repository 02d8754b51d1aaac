#include "solve/saddle_point.hpp"

#include <algorithm>

#include "base/stopwatch.hpp"
#include "solve/bordered_system.hpp"

namespace mortise {
namespace {

// Back to the system's units: rows over their size are lengths, multipliers over it stresses.
void take_over(const SaddlePointSystem& s, ActiveSetResult&& set, SaddlePointSolution& solution) {
  using Status = SaddlePointSolution::Status;
  solution.active = std::move(set.active);
  solution.steps = std::move(set.steps);
  solution.coarse_steps = set.coarse_steps;
  solution.unsettled = std::move(set.wrong);
  solution.drift = std::move(set.drift);
  if (set.dependent_row < 0) solution.loose = set.system->loose();
  solution.failed_at = set.dependent_row;
  for (ActiveSetStep& step : solution.steps) step.pull *= s.stiffness_scale;
  if (set.status == ActiveSetResult::Status::dependent_row) solution.status = Status::dependent_constraints;
  if (set.status == ActiveSetResult::Status::not_settled) solution.status = Status::not_settled;
  if (set.status == ActiveSetResult::Status::unheld) solution.status = Status::unheld;
}

// The largest displacement without contact, floating bodies held by their springs: what gaps are differences of.
double free_displacement(const SaddlePointSystem& s, const BorderedCholesky& factor, Eigen::Index border) {
  return largest(largest_entry(s.value), largest_entry(factor.backward(VecX::Zero(border))));
}

// K u, and |K| |u|: the sizes of the terms that each entry is the sum of.
struct Product {
  VecX sum, size;
};

Product multiply(const SparseMatrix& lower, const VecX& u) {
  Product p{VecX::Zero(u.size()), VecX::Zero(u.size())};
  const auto add = [&](int row, double term) {
    p.sum(row) += term;
    p.size(row) += std::abs(term);
  };
  for (int j = 0; j < int(lower.cols()); ++j)
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
      add(int(it.row()), it.value() * u(j));
      if (it.row() != j) add(j, it.value() * u(it.row()));
    }
  return p;
}

}  // namespace

std::vector<int> held_unknowns(const std::vector<int>& grounded, const SaddlePointSolution& solution) {
  std::vector<int> held;
  for (Eigen::Index k = 0; k < solution.loose.rows(); ++k)
    if (solution.loose.cols() > 0 && largest_entry(solution.loose.row(k).transpose()) > 1e-6)
      held.push_back(grounded[k]);
  return held;
}

void measure_residuals(const SaddlePointSystem& s, SaddlePointSolution& solution) {
  const Product Ku = multiply(s.K, solution.u);
  const VecX pressure = s.B.transpose() * solution.lambda;
  const double forces = largest({largest_entry(s.f), largest_entry(Ku.sum), largest_entry(pressure)});
  solution.force_residual = fraction(0, forces);
  std::vector<char> held = s.fixed;
  for (const int unknown : held_unknowns(s.grounded, solution)) held[unknown] = 1;
  for (Eigen::Index i = 0; i < pressure.size(); ++i)
    if (!held[i])
      solution.force_residual = largest(solution.force_residual, fraction(std::abs(s.f(i) - Ku.sum(i) - pressure(i)),
                                                                          largest(forces, rigid_part * Ku.size(i))));
  VecX open = (s.g - s.B * solution.u).cwiseQuotient(s.row_scale);
  for (Eigen::Index a = 0; a < open.size(); ++a)
    if (!solution.active[a]) open(a) = 0;
  solution.constraint_residual = fraction(largest_entry(open), largest_entry(solution.u));
}

SaddlePointSolution solve_saddle_point(const SaddlePointSystem& s) {
  SaddlePointSolution solution;
  Stopwatch watch;
  const Eigen::Index m = s.B.rows();
  BorderedSystem reduced = bordered_system({s.K, s.B, s.fixed, s.stiffness_scale, s.row_scale, s.grounded});
  BorderedCholesky factor(std::move(reduced.matrix), reduced.blocks);
  const std::vector<int>& free = reduced.free;
  if (factor.failed_at() >= 0) {
    solution.status = SaddlePointSolution::Status::not_positive_definite;
    solution.failed_at = free[std::min(factor.failed_at(), int(free.size()) - 1)];
    return solution;
  }
  solution.factorise_seconds = watch.lap();

  solution.u = s.value;
  solution.lambda = VecX::Zero(m);
  const std::vector<char> unilateral = s.unilateral.empty() ? std::vector<char>(m, 0) : s.unilateral;
  const auto symmetric = s.K.selfadjointView<Eigen::Lower>();
  VecX Ku = symmetric * solution.u;
  std::optional<MultiplierSystem> multipliers;  // of the active set
  // The first pass solves, as a rule to round-off of the residual itself; a second one refines where it did not.
  for (int pass = 0; pass < 2; ++pass) {
    const VecX Bl = s.B.transpose() * solution.lambda;
    VecX force(free.size());
    for (std::size_t i = 0; i < free.size(); ++i)
      force(i) = (s.f(free[i]) - Ku(free[i]) - Bl(free[i])) / s.stiffness_scale;
    VecX rhs = factor.forward(force);
    rhs.head(m) -= (s.g - s.B * solution.u).cwiseQuotient(s.row_scale);
    VecX lambda;
    if (pass == 0) {
      const double round_off = s.unilateral.empty() ? 0 : 1e-12 * free_displacement(s, factor, rhs.size());
      ActiveSetResult set =
          settle_active_set({factor.border_compliance(), rhs, s.row_scale, unilateral, round_off}, s.start);
      lambda = std::move(set.solution);
      take_over(s, std::move(set), solution);
      multipliers = std::move(set.system);
      using Status = SaddlePointSolution::Status;
      if (solution.status == Status::dependent_constraints || solution.status == Status::unheld) return solution;
    } else {
      lambda = multipliers->solve(rhs);
    }
    const VecX u = factor.backward(lambda);
    for (std::size_t i = 0; i < free.size(); ++i) solution.u(free[i]) += u(i);
    solution.lambda += s.stiffness_scale * lambda.head(m).cwiseQuotient(s.row_scale);
    Ku = symmetric * solution.u;
    measure_residuals(s, solution);
    if (largest(solution.force_residual, solution.constraint_residual) < 1e-11) break;
  }
  if (!std::isfinite(largest(solution.force_residual, solution.constraint_residual)))
    solution.status = SaddlePointSolution::Status::not_settled;
  solution.solve_seconds = watch.lap();
  return solution;
}

}  // namespace mortise
