#include "solve/direct.hpp"

#include <algorithm>

#include "base/stopwatch.hpp"
#include "solve/active_set.hpp"
#include "solve/bordered_system.hpp"
#include "solve/contact_factor.hpp"

namespace mortise {
namespace {

VecX on(const std::vector<int>& free, const VecX& v) { return v(free); }

}  // namespace

Solution solve_directly(const SaddlePointSystem& s) {
  Solution solution;
  Stopwatch watch;
  const Eigen::Index m = s.B.rows();
  BorderedSystem reduced = bordered_system(s);
  BorderedCholesky factor(std::move(reduced.matrix), reduced.blocks);
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
  std::optional<MultiplierSystem> multipliers;  // of the active set
  // The first pass solves, as a rule to round-off of the residual itself; a second one refines where it did not.
  for (int pass = 0; pass < 2; ++pass) {
    const VecX unbalanced = s.f - Ku - s.B.transpose() * solution.lambda;
    const VecX y = factor.forward(on(free, unbalanced) / s.stiffness_scale);
    VecX rhs = factor.at_border(y);
    rhs.head(m) -= (s.g - s.B * solution.u).cwiseQuotient(s.row_scale);
    VecX lambda;
    if (pass == 0) {
      // The largest displacement without contact, floating bodies held by their springs: what gaps are differences of.
      const auto free_displacement = [&] {
        return largest(largest_entry(s.constraints.value), largest_entry(factor.backward(y, VecX::Zero(rhs.size()))));
      };
      const ComplementarityProblem problem{
          .compliance = factor.take_border_compliance(),
          .scale = s.row_scale,
          .unilateral = s.unilateral.empty() ? std::vector<char>(m, 0) : s.unilateral,
          .round_off = s.unilateral.empty() ? 0 : 1e-12 * free_displacement(),
      };
      ActiveSetResult set = find_active_set(problem, rhs, s.start);
      take_active_set(s, set, solution);
      if (solution.status == SolveStatus::dependent_row || solution.status == SolveStatus::unconstrained)
        return solution;
      lambda = stacked(set.lambda, set.mu);
      multipliers = std::move(set.system);
    } else {
      lambda = multipliers->solve(rhs);
    }
    solution.u(free) += factor.backward(y, lambda);
    solution.lambda += s.stiffness_scale * lambda.head(m).cwiseQuotient(s.row_scale);
    Ku = symmetric * solution.u;
    measure_residuals(s, solution);
    if (largest(solution.force_residual, solution.constraint_residual) < 1e-11) break;
  }
  if (!std::isfinite(largest(solution.force_residual, solution.constraint_residual)))
    solution.status = SolveStatus::not_converged;
  solution.factor =
      std::make_shared<DirectFactor>(s, std::move(reduced.free), std::move(factor), *std::move(multipliers));
  solution.solve_seconds = watch.lap();
  return solution;
}

}  // namespace mortise
