#include "preprint_solvers/solve_ddm.hpp"

#include <algorithm>
#include <limits>
#include <sstream>

#include "base/stopwatch.hpp"
#include "preprint_solvers/ddm_rows.hpp"
#include "solve/active_set.hpp"

namespace mortise {
namespace {

// Motions of the groups' springs, the Neumann group's first, in the order of the system's.
MatX as_grounded(const SaddlePointSystem& s, const BodyGroup& neumann, const MatX& motions) {
  MatX all(motions.rows(), motions.cols());
  Eigen::Index first = 0, second = neumann.motions;
  for (std::size_t k = 0; k < s.grounded.size(); ++k)
    all.row(k) = motions.row(neumann.has(s.grounded[k]) ? first++ : second++);
  return all;
}

// Displacements of the groups in the end.
void set_solution(const SaddlePointSystem& s, const GroupPair& groups, const VecX& lambda, const VecX& mu,
                  Solution& solution) {
  const BodyGroup &neumann = groups.neumann, &dirichlet = groups.dirichlet;
  solution.lambda = s.stiffness_scale * lambda.cwiseQuotient(s.row_scale);
  solution.u = s.constraints.value;
  neumann.add_displacements(neumann.load, lambda, mu.head(neumann.motions), solution.u);
  dirichlet.add_displacements(dirichlet.load, lambda, mu.tail(dirichlet.motions), solution.u);
  measure_residuals(s, solution);
  if (solution.force_residual <= 1e-11) return;
  const VecX Ku = s.K.selfadjointView<Eigen::Lower>() * solution.u;
  const VecX unbalanced = (s.f - Ku - s.B.transpose() * solution.lambda) / s.stiffness_scale;
  const VecX none = VecX::Zero(lambda.size());
  for (const BodyGroup* group : {&neumann, &dirichlet})
    group->add_displacements(group->answer(unbalanced), none, VecX::Zero(group->motions), solution.u);
  measure_residuals(s, solution);
}

constexpr double stiff = 1e4;  // with largest eigenvalues below this it converges (docs/theory.md, section 11)

// The Krylov iteration needs no eigenvalues, but they say why it did not end.
Iteration record(const DdmOptions& options, const DdmRows& rows, SolveStatus status) {
  const bool krylov = options.acceleration == Acceleration::krylov;
  const Spectrum e = krylov && status != SolveStatus::converged ? rows.closed_spectrum() : rows.interface_spectrum();
  std::ostringstream settings, advice;
  if (rows.beta() > 0)
    settings << "beta " << rows.beta() << " (closed contact: best " << e.best_beta() << ", converges below "
             << e.largest_beta() << ")";
  if (e.largest > 0) {
    advice << "the eigenvalues of the interface are " << e.smallest << " ... " << e.largest << ": ";
    if (krylov)
      advice << (e.largest > stiff
                     ? "a body that takes the displacement is so much stiffer than its opposites, in "
                       "itself or between two of them"
                     : "a multiplier is hardly felt on the side that takes the displacement, and round-off is left")
             << "; expected method.solver = \"feti\" or \"direct\"";
    else
      advice << "beta converges below " << e.largest_beta() << ", best at " << e.best_beta();
  }
  return {.method = to_string(options.scheme),
          .acceleration = options.acceleration,
          .settings = settings.str(),
          .advice = advice.str(),
          .tolerance = options.tolerance,
          .steps = int(rows.history().size()),
          .convergence_rate = rows.convergence_rate(),
          .history = rows.history(),
          .figures = {{"beta", rows.beta()}, {"eigenvalue.smallest", e.smallest}, {"eigenvalue.largest", e.largest}}};
}

// What this method expects where it has no solution.
std::string expectation(SolveStatus status, Scheme scheme) {
  const bool one_side = scheme == Scheme::neumann_dirichlet;
  if (status == SolveStatus::dependent_row)
    return std::string("is not felt by the bodies that take the displacement") +
           (one_side ? "" : " (all, with scheme = \"" + to_string(scheme) + "\")") +
           ": expected contact.multipliers_on to name " +
           (one_side ? "the curve of the body that takes the displacement (or the coarser curve)"
                     : "the coarser curve, or scheme = \"neumann_dirichlet\"") +
           ", or method.solver = \"direct\"";
  return {};
}

Solution without_solution(SolveStatus status, int failed_at, Scheme scheme) {
  Solution solution;
  solution.status = status;
  solution.failed_at = failed_at;
  solution.advice = expectation(status, scheme);
  return solution;
}

}  // namespace

Solution solve_by_ddm(const SaddlePointSystem& s, const std::vector<char>& dirichlet, const DdmOptions& options) {
  Solution solution;
  Stopwatch watch;
  std::vector<char> others(dirichlet.size());
  for (std::size_t i = 0; i < dirichlet.size(); ++i) others[i] = !dirichlet[i];
  BodyGroup neumann_group(s, others), dirichlet_group(s, dirichlet);
  solution.factorise_seconds = watch.lap();
  for (const BodyGroup* group : {&neumann_group, &dirichlet_group})
    if (group->failed_at >= 0)
      return without_solution(SolveStatus::not_positive_definite, group->failed_at, options.scheme);

  const GroupPair groups = group_pair(std::move(neumann_group), std::move(dirichlet_group), s);
  DdmRows rows(groups, options);
  const auto solve_from = [&](std::vector<char> closed) {
    ActiveSetResult set = find_active_set(rows, std::move(closed));
    if (set.free_motions.cols() > 0) set.free_motions = as_grounded(s, groups.neumann, set.free_motions);
    if (set.driven_mode.size() > 0) set.driven_mode = as_grounded(s, groups.neumann, set.driven_mode);
    take_active_set(s, set, solution);
    if (set.lambda.size() > 0) set_solution(s, groups, set.lambda, set.mu, solution);
  };
  solve_from(std::vector<char>(s.B.rows(), 1));
  if (solution.status == SolveStatus::dependent_row || solution.status == SolveStatus::unconstrained) {
    solution.advice = expectation(solution.status, options.scheme);
    return solution;
  }
  // Converged in the groups' terms is not yet in those of contact, as a multiplier may be hardly felt: on with less.
  for (double asked = options.tolerance, last = std::numeric_limits<double>::infinity();
       solution.status == SolveStatus::converged && solution.constraint_residual > options.tolerance &&
       solution.constraint_residual < last;) {
    last = solution.constraint_residual;
    asked *= 0.5 * options.tolerance / last;
    rows.go_on_to(asked);
    solve_from(solution.active);
  }
  solution.constraint_tolerance = options.tolerance;
  if (!std::isfinite(largest(solution.force_residual, solution.constraint_residual)))
    solution.status = SolveStatus::diverged;
  if (solution.status == SolveStatus::converged && solution.constraint_residual > options.tolerance)
    solution.status = SolveStatus::not_converged;
  solution.iteration = record(options, rows, solution.status);
  solution.solve_seconds = watch.lap();
  return solution;
}

}  // namespace mortise
