#include "preprint_solvers/solve_ddm.hpp"

#include <algorithm>
#include <sstream>

#include "base/stopwatch.hpp"
#include "preprint_solvers/interface.hpp"

namespace mortise {
namespace {

InterfaceIteration make_iteration(Scheme scheme, const Interface& interface) {
  switch (scheme) {
    case Scheme::neumann_dirichlet:
      return neumann_dirichlet(interface, Rows::closed);
    case Scheme::neumann_neumann:
      return neumann_neumann(interface);
    case Scheme::dirichlet_dirichlet:
      return dirichlet_dirichlet(interface);
  }
  return {};
}

// One or more iterations, one after the other, and what is known of them.
struct Run {
  SolveStatus status = SolveStatus::not_converged;
  VecX lambda;               // m: the last iterate's multipliers
  Rows rows = Rows::closed;  // what it was solved with
  std::vector<IterationStep> history;
  double beta = 0, convergence_rate = 0;
  Spectrum spectrum;
};

// Adds an iteration to the run, and returns its last iterate.
VecX add(const InterfaceIteration& iteration, const Measure& measure, const RelaxationOptions& options, Run& run) {
  RelaxationResult result = relax(iteration.correction, measure, iteration.start, options);
  const double before = run.history.empty() ? 0 : run.history.back().seconds;
  for (IterationStep& step : result.history) {
    step.seconds += before;
    run.history.push_back(step);
  }
  run.convergence_rate = result.convergence_rate;
  run.status = result.status;
  return std::move(result.x);
}

bool in_tension(const SaddlePointSystem& s, const VecX& lambda) {
  constexpr double round_off = 1e-10;  // of the largest multiplier over its scale
  const VecX size = lambda.cwiseQuotient(s.row_scale);
  const double limit = round_off * largest_entry(size);
  for (std::size_t a = 0; a < s.unilateral.size(); ++a)
    if (s.unilateral[a] && size(a) > limit) return true;
  return false;
}

// Unilateral contact by Newton's method: the Dirichlet group's contact under lambda says which rows are closed, and GCR
// finds lambda with these closed. It starts from all rows closed, where a rough lambda will do.
Run by_newton(const Interface& interface, const InterfaceIteration& closed, const DdmOptions& options) {
  const Measure measure = [&](const VecX& x, const VecX& z) { return residuals(interface, x, z); };
  Run run;
  run.lambda = add(closed, measure, {Acceleration::krylov, 1, 0.1, options.max_iterations}, run);
  run.rows = Rows::unilateral;
  DirichletSolution taken;
  while (true) {
    taken = solve_dirichlet(interface, Rows::unilateral, run.lambda, taken.active);
    const bool converged = measure(run.lambda, taken.lambda - run.lambda).largest() <= options.tolerance;
    run.status = converged ? SolveStatus::converged : SolveStatus::not_converged;
    const int left = options.max_iterations - int(run.history.size());
    if (converged || !taken.held || left <= 0) return run;
    run.lambda = add(neumann_dirichlet(interface, *std::move(taken.closed), taken.lambda), measure,
                     {Acceleration::krylov, 1, options.tolerance, left}, run);
  }
}

// The scheme as it stands, with the chosen acceleration: first with all rows closed, then, where these are in tension,
// with those open that may be.
Run by_relaxation(const SaddlePointSystem& s, const Interface& interface, const InterfaceIteration& closed,
                  const DdmOptions& options) {
  Run run;
  RelaxationOptions relaxation{options.acceleration, 1, options.tolerance, options.max_iterations};
  if (options.acceleration != Acceleration::krylov) {
    run.spectrum = spectrum(closed);
    relaxation.beta = run.beta = options.beta.value_or(run.spectrum.best_beta());
  }
  // z of the Neumann-Dirichlet iteration is at hand; the other schemes ask the Dirichlet group.
  const bool direct = options.scheme == Scheme::neumann_dirichlet;
  const Measure measure = [&](const VecX& x, const VecX& z) {
    if (direct) return residuals(interface, x, z);
    const VecX lambda = closed.multipliers(x);
    return residuals(interface, lambda, solve_dirichlet(interface, Rows::closed, lambda).lambda - lambda);
  };
  run.lambda = closed.multipliers(add(closed, measure, relaxation, run));
  if (run.status != SolveStatus::converged || !in_tension(s, run.lambda)) return run;
  if (!direct) {
    run.status = SolveStatus::in_tension;
    return run;
  }
  run.rows = Rows::unilateral;
  InterfaceIteration opening = neumann_dirichlet(interface, Rows::unilateral);
  opening.start = run.lambda;
  run.lambda = add(opening, measure, relaxation, run);
  return run;
}

// Motions of the groups' springs, the Neumann group's first, in the order of the system's.
MatX as_grounded(const SaddlePointSystem& s, const BodyGroup& neumann, const MatX& motions) {
  MatX all(motions.rows(), motions.cols());
  Eigen::Index first = 0, second = neumann.motions;
  for (std::size_t k = 0; k < s.grounded.size(); ++k)
    all.row(k) = motions.row(neumann.has(s.grounded[k]) ? first++ : second++);
  return all;
}

// Displacements and multipliers from the last iterate. What the Dirichlet group takes is a step further than lambda, in
// balance, and nowhere in tension where contact may open.
void set_solution(const SaddlePointSystem& s, const Interface& interface, const Run& run, Solution& solution) {
  const VecX lambda = solve_dirichlet(interface, run.rows, run.lambda).lambda;
  const DirichletSolution taken = solve_dirichlet(interface, run.rows, lambda);
  const BodyGroup &neumann = interface.neumann, &dirichlet = interface.dirichlet;
  solution.active = taken.active;
  if (solution.active.empty()) solution.active.assign(s.B.rows(), 1);
  if (taken.closed) solution.rigid_modes = as_grounded(s, neumann, taken.closed->rigid_modes());
  solution.lambda = s.stiffness_scale * lambda.cwiseQuotient(s.row_scale);
  solution.u = s.constraints.value;
  neumann.add_displacements(neumann.load, lambda, taken.mu.head(neumann.motions), solution.u);
  dirichlet.add_displacements(dirichlet.load, lambda, taken.mu.tail(dirichlet.motions), solution.u);
  measure_residuals(s, solution);
  if (solution.force_residual <= 1e-11) return;
  const VecX Ku = s.K.selfadjointView<Eigen::Lower>() * solution.u;
  const VecX unbalanced = (s.f - Ku - s.B.transpose() * solution.lambda) / s.stiffness_scale;
  const VecX none = VecX::Zero(lambda.size());
  for (const BodyGroup* group : {&neumann, &dirichlet})
    group->add_displacements(group->answer(unbalanced), none, VecX::Zero(group->motions), solution.u);
  measure_residuals(s, solution);
}

Iteration record(const DdmOptions& options, const Run& run) {
  const Spectrum& e = run.spectrum;
  std::ostringstream settings, advice;
  if (run.beta > 0)
    settings << "beta " << run.beta << " (closed contact: best " << e.best_beta() << ", converges below "
             << e.largest_beta() << ")";
  if (e.largest > 0)
    advice << "the eigenvalues of the interface are " << e.smallest << " ... " << e.largest << ": beta converges below "
           << e.largest_beta() << ", best at " << e.best_beta();
  return {.method = to_string(options.scheme),
          .acceleration = options.acceleration,
          .settings = settings.str(),
          .advice = advice.str(),
          .tolerance = options.tolerance,
          .steps = int(run.history.size()),
          .convergence_rate = run.convergence_rate,
          .history = run.history,
          .figures = {{"beta", run.beta}, {"eigenvalue.smallest", e.smallest}, {"eigenvalue.largest", e.largest}}};
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
  if (status == SolveStatus::unconstrained) return "method.solver = \"direct\" names the motion";
  if (status == SolveStatus::in_tension)
    return "method.scheme = \"" + to_string(scheme) +
           "\" is for bilateral contact, and contact is in tension here; expected \"neumann_dirichlet\", or "
           "contact.condition = \"bilateral\"";
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

  const Interface interface = make_interface(std::move(neumann_group), std::move(dirichlet_group), s);
  const InterfaceIteration closed = make_iteration(options.scheme, interface);
  if (closed.dependent_row >= 0)
    return without_solution(SolveStatus::dependent_row, closed.dependent_row, options.scheme);
  const bool may_open = std::find(s.unilateral.begin(), s.unilateral.end(), 1) != s.unilateral.end();
  const bool newton =
      may_open && options.scheme == Scheme::neumann_dirichlet && options.acceleration == Acceleration::krylov;
  const Run run = newton ? by_newton(interface, closed, options) : by_relaxation(s, interface, closed, options);
  if (run.status == SolveStatus::in_tension) return without_solution(run.status, -1, options.scheme);
  if (!solve_dirichlet(interface, run.rows, run.lambda).held)
    return without_solution(SolveStatus::unconstrained, -1, options.scheme);
  set_solution(s, interface, run, solution);
  solution.status = run.status;
  solution.iteration = record(options, run);
  solution.constraint_tolerance = options.tolerance;
  if (!std::isfinite(largest(solution.force_residual, solution.constraint_residual)))
    solution.status = SolveStatus::diverged;
  // Converged in the groups' terms is not yet in those of contact: a multiplier may be hardly felt, and the last step
  // is not relaxed.
  if (solution.status == SolveStatus::converged && solution.constraint_residual > options.tolerance)
    solution.status = SolveStatus::not_converged;
  solution.solve_seconds = watch.lap();
  return solution;
}

}  // namespace mortise
