#include "ddm/solve_ddm.hpp"

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

// Runs one iteration, adds to the history, and returns the multipliers.
// `closed` is the iteration with all contact closed, whose spectrum says what beta to take.
VecX run(const Interface& interface, const InterfaceIteration& iteration, const InterfaceIteration& closed,
         const DdmOptions& options, const StepReport& report, DdmSolution& d) {
  const bool direct = options.scheme == Scheme::neumann_dirichlet;
  RelaxationOptions relaxation{options.acceleration, 1, options.tolerance, options.max_iterations};
  if (!iteration.affine && options.acceleration == Acceleration::krylov)
    relaxation.acceleration = Acceleration::anderson;
  if (relaxation.acceleration != Acceleration::krylov) {
    if (d.spectrum.largest == 0) d.spectrum = spectrum(closed);
    relaxation.beta = d.beta = options.beta.value_or(d.spectrum.best_beta());
  }
  // z of the Neumann-Dirichlet iteration is at hand; the other schemes ask the Dirichlet group.
  const Measure measure = [&](const VecX& x, const VecX& z) {
    if (direct) return residuals(interface, x, z);
    const VecX lambda = iteration.multipliers(x);
    return residuals(interface, lambda, dirichlet_takes(interface, lambda).lambda - lambda);
  };
  RelaxationResult result = relax(iteration.correction, measure, iteration.start, relaxation, report);
  d.history.insert(d.history.end(), result.history.begin(), result.history.end());
  d.factor = result.factor;
  using Status = RelaxationResult::Status;
  d.status = result.status == Status::converged  ? DdmSolution::Status::converged
             : result.status == Status::diverged ? DdmSolution::Status::diverged
                                                 : DdmSolution::Status::not_converged;
  return iteration.multipliers(result.x);
}

bool pulls(const SaddlePointSystem& s, const VecX& lambda) {
  const VecX size = lambda.cwiseQuotient(s.row_scale);
  const double limit = ActiveSetOptions{}.pull_tolerance * largest_entry(size);
  for (std::size_t a = 0; a < s.unilateral.size(); ++a)
    if (s.unilateral[a] && size(Eigen::Index(a)) > limit) return true;
  return false;
}

// Displacements and multipliers from the last iterate. What the Dirichlet group takes is a step further than lambda, in
// balance, and nowhere pulls where contact may open.
void finish(const SaddlePointSystem& s, const Interface& interface, const VecX& iterate,
            std::array<BodyGroup*, 2> groups, SaddlePointSolution& solution) {
  const VecX lambda = dirichlet_takes(interface, iterate).lambda;
  const Taken taken = dirichlet_takes(interface, lambda);
  solution.active = taken.active;
  if (solution.active.empty()) solution.active.assign(std::size_t(s.B.rows()), 1);
  solution.lambda = s.stiffness_scale * lambda.cwiseQuotient(s.row_scale);
  solution.u = s.value;
  groups[0]->add_displacements(lambda, taken.mu.head(groups[0]->motions), solution.u);
  groups[1]->add_displacements(lambda, taken.mu.tail(groups[1]->motions), solution.u);
  measure_residuals(s, solution);
  if (solution.force_residual <= 1e-11) return;
  const VecX Ku = s.K.selfadjointView<Eigen::Lower>() * solution.u;
  const VecX unbalanced = (s.f - Ku - load_rows(s).transpose() * solution.lambda) / s.stiffness_scale;
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
      d.status = DdmSolution::Status::not_positive_definite;
      solution.failed_at = group->failed_at;
      return d;
    }

  if (s.loads && (neumann_group.motions > 0 || options.scheme != Scheme::neumann_dirichlet)) {
    d.status = DdmSolution::Status::unbalanced;
    return d;
  }
  const std::vector<char> none;
  const Interface closed = make_interface(neumann_group, dirichlet_group, s, none);
  solution.failed_at = closed.dirichlet_system->dependent_row();
  if (solution.failed_at >= 0) {
    d.status = DdmSolution::Status::dependent_row;
    return d;
  }
  const InterfaceIteration bilateral = make_iteration(options.scheme, closed);
  VecX lambda = run(closed, bilateral, bilateral, options, report, d);
  if (d.status == DdmSolution::Status::converged && pulls(s, lambda)) {
    if (options.scheme != Scheme::neumann_dirichlet) {
      d.status = DdmSolution::Status::cannot_open;
      return d;
    }
    const Interface opening = make_interface(neumann_group, dirichlet_group, s, s.unilateral);
    InterfaceIteration iteration = neumann_dirichlet(opening);
    iteration.start = lambda;
    lambda = run(opening, iteration, bilateral, options, report, d);
    if (!dirichlet_takes(opening, lambda).held) {
      d.status = DdmSolution::Status::unheld;
      return d;
    }
    finish(s, opening, lambda, {&neumann_group, &dirichlet_group}, solution);
  } else {
    finish(s, closed, lambda, {&neumann_group, &dirichlet_group}, solution);
  }
  solution.solve_seconds = watch.lap();
  return d;
}

}  // namespace mortise
