#include "solve/direct.hpp"

#include <algorithm>

#include "base/stopwatch.hpp"
#include "solve/active_set.hpp"
#include "solve/bordered_system.hpp"
#include "solve/contact_factor.hpp"

namespace mortise {
namespace {

constexpr int max_passes = 6;

VecX on(const std::vector<int>& free, const VecX& v) { return v(free); }

}  // namespace

Solution solve_directly(const SaddlePointSystem& s) {
  Solution solution;
  Stopwatch watch;
  const Eigen::Index m = s.B.rows();
  BorderedSystem reduced = bordered_system(s);
  SplitCholesky factor(std::move(reduced.matrix), reduced.blocks);
  const std::vector<int>& free = reduced.free;
  if (factor.failed_at() >= 0) {
    solution.status = SolveStatus::not_positive_definite;
    solution.failed_at = free[std::min(factor.failed_at(), int(free.size()) - 1)];
    return solution;
  }
  solution.factorise_seconds = watch.lap();

  solution.u = s.constraints.value;
  solution.lambda = VecX::Zero(m);
  const auto symmetric = s.K.selfadjointView<Eigen::Lower>();
  VecX Ku = symmetric * solution.u;
  ComplementarityProblem problem{.compliance = factor.take_border_compliance(),
                                 .scale = s.row_scale,
                                 .unilateral = s.unilateral.empty() ? std::vector<char>(m, 0) : s.unilateral};
  std::optional<MultiplierSystem> multipliers;  // of the active set
  // The first pass solves, as a rule to round-off of the residual itself; others refine where it did not.
  bool penetrated = false;
  for (int pass = 0; pass < max_passes; ++pass) {
    const VecX unbalanced = s.f - Ku - s.B.transpose() * solution.lambda;
    const VecX y = factor.forward(on(free, unbalanced) / s.stiffness_scale);
    VecX rhs = factor.at_border(y);
    rhs.head(m) -= (s.g - s.B * solution.u).cwiseQuotient(s.row_scale);
    VecX lambda;
    if (pass > 0 && !penetrated) {
      lambda = multipliers->solve(rhs);
    } else {
      if (pass > 0) {
        problem.known = solution.lambda.cwiseProduct(s.row_scale) / s.stiffness_scale;
        problem.displacement = largest_entry(solution.u);
        problem.round_off = 0;
      } else if (!s.unilateral.empty()) {
        // Of the largest displacement without contact, floating bodies held by their springs: gaps are its differences.
        problem.round_off = 1e-12 * largest(largest_entry(s.constraints.value),
                                            largest_entry(factor.backward(y, VecX::Zero(rhs.size()))));
      }
      ActiveSetResult set = find_active_set(problem, rhs, pass > 0 ? solution.active : s.start);
      if (pass > 0 && set.status != SolveStatus::converged) break;  // those before stay, and the checks look at them
      take_active_set(s, set, solution);
      if (solution.status == SolveStatus::dependent_row || solution.status == SolveStatus::unconstrained)
        return solution;
      if (pass > 0) set.lambda -= problem.known;
      lambda = stacked(set.lambda, set.mu);
      multipliers = std::move(set.system);
    }
    solution.u(free) += factor.backward(y, lambda);
    solution.lambda += s.stiffness_scale * lambda.head(m).cwiseQuotient(s.row_scale);
    Ku = symmetric * solution.u;
    measure_residuals(s, solution);
    const bool exact = largest(solution.force_residual, solution.constraint_residual) < 1e-11;
    if (solution.status != SolveStatus::converged || (pass > 0 && !penetrated && !exact)) break;
    penetrated = penetrates(s, solution);
    if (exact && !penetrated) break;
  }
  if (!std::isfinite(largest(solution.force_residual, solution.constraint_residual)))
    solution.status = SolveStatus::not_converged;
  solution.factor =
      std::make_shared<DirectFactor>(s, std::move(reduced.free), std::move(factor), *std::move(multipliers));
  solution.solve_seconds = watch.lap();
  return solution;
}

}  // namespace mortise
