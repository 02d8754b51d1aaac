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
  solution.driven = set.driven;
  solution.failed_at = set.dependent_row;
  for (ActiveSetStep& step : solution.steps) step.pull *= s.stiffness_scale;
  if (set.status == ActiveSetResult::Status::dependent_row) solution.status = Status::dependent_constraints;
  if (set.status == ActiveSetResult::Status::not_settled) solution.status = Status::not_settled;
  if (set.status == ActiveSetResult::Status::unheld) solution.status = Status::unheld;
}

// The largest displacement without contact, floating bodies held by their springs: what gaps are differences of.
double free_displacement(const SaddlePointSystem& s, const BorderedCholesky& factor, Eigen::Index border) {
  return std::max(largest_entry(s.value), largest_entry(factor.backward(VecX::Zero(border))));
}

}  // namespace

void measure_residuals(const SaddlePointSystem& s, SaddlePointSolution& solution) {
  const VecX Ku = s.K.selfadjointView<Eigen::Lower>() * solution.u,
             pressure = load_rows(s).transpose() * solution.lambda;
  double worst = 0;
  for (Eigen::Index i = 0; i < Ku.size(); ++i)
    if (!s.fixed[std::size_t(i)]) worst = std::max(worst, std::abs(s.f(i) - Ku(i) - pressure(i)));
  const double largest = largest_entry(solution.u);
  const double size = std::max(
      {largest_entry(s.f), largest_entry(Ku), largest_entry(pressure), rigid_part * s.stiffness_scale * largest});
  solution.force_residual = size > 0 ? worst / size : 0;
  VecX open = (s.g - s.B * solution.u).cwiseQuotient(s.row_scale);
  for (Eigen::Index a = 0; a < open.size(); ++a)
    if (!solution.active[std::size_t(a)]) open(a) = 0;
  solution.constraint_residual = largest > 0 ? largest_entry(open) / largest : 0;
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
    solution.failed_at = free[std::size_t(std::min<std::size_t>(std::size_t(factor.failed_at()), free.size() - 1))];
    return solution;
  }
  solution.factorise_seconds = watch.lap();

  solution.u = s.value;
  solution.lambda = VecX::Zero(m);
  const std::vector<char> unilateral = s.unilateral.empty() ? std::vector<char>(std::size_t(m), 0) : s.unilateral;
  const auto symmetric = s.K.selfadjointView<Eigen::Lower>();
  VecX Ku = symmetric * solution.u;
  std::optional<MultiplierSystem> multipliers;  // of the active set
  // The first pass solves, as a rule to round-off of the residual itself; a second one refines where it did not.
  for (int pass = 0; pass < 2; ++pass) {
    const VecX Bl = s.B.transpose() * solution.lambda;
    VecX force(Eigen::Index(free.size()));
    for (std::size_t i = 0; i < free.size(); ++i)
      force(Eigen::Index(i)) = (s.f(free[i]) - Ku(free[i]) - Bl(free[i])) / s.stiffness_scale;
    VecX rhs = factor.forward(force);
    rhs.head(m) -= (s.g - s.B * solution.u).cwiseQuotient(s.row_scale);
    VecX lambda;
    if (pass == 0) {
      const double round_off = s.unilateral.empty() ? 0 : 1e-12 * free_displacement(s, factor, rhs.size());
      ActiveSetResult set =
          settle_active_set({factor.border_compliance(), rhs, s.row_scale, unilateral, round_off}, s.start);
      lambda = std::move(set.solution);
      multipliers = std::move(set.system);
      take_over(s, std::move(set), solution);
      using Status = SaddlePointSolution::Status;
      if (solution.status == Status::dependent_constraints || solution.status == Status::unheld) return solution;
    } else {
      lambda = multipliers->solve(rhs);
    }
    const VecX u = factor.backward(lambda);
    for (std::size_t i = 0; i < free.size(); ++i) solution.u(free[i]) += u(Eigen::Index(i));
    solution.lambda += s.stiffness_scale * lambda.head(m).cwiseQuotient(s.row_scale);
    Ku = symmetric * solution.u;
    measure_residuals(s, solution);
    if (std::max(solution.force_residual, solution.constraint_residual) < 1e-11) break;
  }
  solution.solve_seconds = watch.lap();
  return solution;
}

}  // namespace mortise
