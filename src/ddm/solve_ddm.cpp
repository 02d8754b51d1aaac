#include "ddm/solve_ddm.hpp"

#include <algorithm>

#include "base/stopwatch.hpp"

namespace mortise {
namespace {

InterfaceIteration make_iteration(Scheme scheme, const Interface& interface) {
  switch (scheme) {
    case Scheme::neumann_dirichlet:
      return neumann_dirichlet(interface);
    case Scheme::neumann_neumann:
      return neumann_neumann(interface);
    case Scheme::dirichlet_dirichlet:
      return dirichlet_dirichlet(interface);
  }
  return {};
}

using Status = DdmSolution::Status;

constexpr double far_off = 1e3;  // times the tolerance: what contact is left open is not what the iteration measured

// Runs an iteration, adds it to d, and returns the last iterate.
VecX run(const InterfaceIteration& iteration, const Measure& measure, const RelaxationOptions& options,
         const StepReport& report, DdmSolution& d) {
  RelaxationResult result = relax(iteration.correction, measure, iteration.start, options, report);
  const double before = d.history.empty() ? 0 : d.history.back().seconds;
  for (RelaxationStep& step : result.history) {
    step.seconds += before;
    d.history.push_back(step);
  }
  d.factor = result.factor;
  d.status = result.status == RelaxationResult::Status::converged  ? Status::converged
             : result.status == RelaxationResult::Status::diverged ? Status::diverged
                                                                   : Status::not_converged;
  return std::move(result.x);
}

bool pulls(const SaddlePointSystem& s, const VecX& lambda) {
  const VecX size = lambda.cwiseQuotient(s.row_scale);
  const double limit = ActiveSetOptions{}.pull_tolerance * largest_entry(size);
  for (std::size_t a = 0; a < s.unilateral.size(); ++a)
    if (s.unilateral[a] && size(a) > limit) return true;
  return false;
}

// Unilateral contact by Newton's method: the Dirichlet group's contact under lambda says which rows are closed, and GCR
// finds lambda with these closed. It starts from all rows closed, where a rough lambda will do.
VecX settle_closed_rows(const SaddlePointSystem& s, Interface& interface, const InterfaceIteration& bilateral,
                        const DdmOptions& options, const StepReport& report, DdmSolution& d) {
  const Measure measure = [&](const VecX& x, const VecX& z) { return residuals(interface, x, z); };
  VecX lambda = run(bilateral, measure, {Acceleration::krylov, 1, 0.1, options.max_iterations}, report, d);
  interface.unilateral = s.unilateral;
  Taken taken;
  while (true) {
    taken = dirichlet_takes(interface, lambda, taken.active);
    const bool converged = measure(lambda, taken.lambda - lambda).largest() <= options.tolerance;
    d.status = converged ? Status::converged : Status::not_converged;
    const int left = options.max_iterations - int(d.history.size());
    if (converged || !taken.held || left <= 0) return lambda;
    lambda = run(neumann_dirichlet(interface, *std::move(taken.closed), taken.lambda), measure,
                 {Acceleration::krylov, 1, options.tolerance, left}, report, d);
  }
}

// The scheme as it stands, with the chosen acceleration: first with all rows closed, then, where that pulls, with those
// of `interface` open that may be.
VecX iterate(const SaddlePointSystem& s, Interface& interface, const InterfaceIteration& closed,
             const DdmOptions& options, const StepReport& report, DdmSolution& d) {
  RelaxationOptions relaxation{options.acceleration, 1, options.tolerance, options.max_iterations};
  if (options.acceleration != Acceleration::krylov) {
    d.spectrum = spectrum(closed);
    relaxation.beta = d.beta = options.beta.value_or(d.spectrum.best_beta());
  }
  // z of the Neumann-Dirichlet iteration is at hand; the other schemes ask the Dirichlet group.
  const bool direct = options.scheme == Scheme::neumann_dirichlet;
  const Measure measure = [&](const VecX& x, const VecX& z) {
    if (direct) return residuals(interface, x, z);
    const VecX lambda = closed.multipliers(x);
    return residuals(interface, lambda, dirichlet_takes(interface, lambda).lambda - lambda);
  };
  const VecX lambda = closed.multipliers(run(closed, measure, relaxation, report, d));
  if (d.status != Status::converged || !pulls(s, lambda)) return lambda;
  if (!direct) {
    d.status = Status::cannot_open;
    return lambda;
  }
  interface.unilateral = s.unilateral;
  InterfaceIteration opening = neumann_dirichlet(interface);
  opening.start = lambda;
  return run(opening, measure, relaxation, report, d);
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
// balance, and nowhere pulls where contact may open.
void finish(const SaddlePointSystem& s, const Interface& interface, const VecX& iterate,
            std::array<BodyGroup*, 2> groups, SaddlePointSolution& solution) {
  const VecX lambda = dirichlet_takes(interface, iterate).lambda;
  const Taken taken = dirichlet_takes(interface, lambda);
  solution.active = taken.active;
  if (taken.closed) solution.loose = as_grounded(s, *groups[0], taken.closed->loose());
  if (solution.active.empty()) solution.active.assign(s.B.rows(), 1);
  solution.lambda = s.stiffness_scale * lambda.cwiseQuotient(s.row_scale);
  solution.u = s.value;
  groups[0]->add_displacements(lambda, taken.mu.head(groups[0]->motions), solution.u);
  groups[1]->add_displacements(lambda, taken.mu.tail(groups[1]->motions), solution.u);
  measure_residuals(s, solution);
  if (solution.force_residual <= 1e-11) return;
  const VecX Ku = s.K.selfadjointView<Eigen::Lower>() * solution.u;
  const VecX unbalanced = (s.f - Ku - s.B.transpose() * solution.lambda) / s.stiffness_scale;
  for (BodyGroup* group : groups) group->refine(unbalanced, solution.u);
  measure_residuals(s, solution);
}

}  // namespace

DdmSolution solve_by_ddm(const SaddlePointSystem& s, const std::vector<char>& dirichlet, const DdmOptions& options,
                         const StepReport& report) {
  DdmSolution d;
  SaddlePointSolution& solution = d.solution;
  Stopwatch watch;
  std::vector<char> others(dirichlet.size());
  for (std::size_t i = 0; i < dirichlet.size(); ++i) others[i] = !dirichlet[i];
  BodyGroup neumann_group(s, others), dirichlet_group(s, dirichlet);
  solution.factorise_seconds = watch.lap();
  for (const BodyGroup* group : {&neumann_group, &dirichlet_group})
    if (group->failed_at >= 0) {
      d.status = Status::not_positive_definite;
      solution.failed_at = group->failed_at;
      return d;
    }

  Interface interface = make_interface(neumann_group, dirichlet_group, s);
  const InterfaceIteration closed = make_iteration(options.scheme, interface);
  solution.failed_at = closed.dependent_row;
  if (solution.failed_at >= 0) {
    d.status = Status::dependent_row;
    return d;
  }
  const bool may_open = std::find(s.unilateral.begin(), s.unilateral.end(), 1) != s.unilateral.end();
  VecX lambda;
  if (may_open && options.scheme == Scheme::neumann_dirichlet && options.acceleration == Acceleration::krylov)
    lambda = settle_closed_rows(s, interface, closed, options, report, d);
  else
    lambda = iterate(s, interface, closed, options, report, d);
  if (d.status == Status::cannot_open) return d;
  if (!dirichlet_takes(interface, lambda).held) {
    d.status = Status::unheld;
    return d;
  }
  finish(s, interface, lambda, {&neumann_group, &dirichlet_group}, solution);
  if (!std::isfinite(largest(solution.force_residual, solution.constraint_residual))) d.status = Status::diverged;
  // Where the groups hardly feel a multiplier, an iterate may look converged in their terms and leave contact open.
  if (d.status == Status::converged && solution.constraint_residual > far_off * options.tolerance)
    d.status = Status::not_converged;
  solution.solve_seconds = watch.lap();
  return d;
}

}  // namespace mortise
