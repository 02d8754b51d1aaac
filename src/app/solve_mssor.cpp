#include "app/solve_mssor.hpp"

#include <sstream>

#include "base/errors.hpp"
#include "solve/mssor.hpp"

namespace mortise {
namespace {

// What the iteration did not reach, and what would.
std::string trouble(const MssorSolution& found, const MssorSpec& spec) {
  const SaddlePointSolution& s = found.solution;
  std::ostringstream text;
  text << "mssor (omega " << spec.omega << ", tau " << spec.tau << ", acceleration " << to_string(spec.acceleration)
       << ") " << (found.status == MssorSolution::Status::diverged ? "diverges" : "did not converge") << ": after "
       << found.steps << " steps the residuals are " << s.constraint_residual << " (kinematic) and " << s.force_residual
       << " (force), where " << spec.tolerance << " was asked for; a step multiplies them by " << found.factor;
  if (found.tau_border > 0) text << "; with this omega it converges for tau below " << found.tau_border;
  if (spec.acceleration == Acceleration::none) text << "; acceleration = \"krylov\" converges for any tau, and faster";
  return text.str();
}

}  // namespace

SaddlePointSolution solve_mssor(const Scene& scene, const SaddlePointSystem& system, Results& r) {
  const MssorSpec& spec = scene.method.mssor;
  MssorSolution found =
      solve_by_mssor(system, {spec.omega, spec.tau, spec.acceleration, spec.tolerance, spec.max_iterations});
  using Reached = MssorSolution::Status;
  if (found.status == Reached::cannot_open)
    throw InputError(scene.path +
                     ": method.solver = \"mssor\" is for contact that stays closed, and contact pulls here; expected "
                     "solver = \"direct\", or contact.condition = \"bilateral\"");
  if (found.status == Reached::not_positive_definite)
    found.solution.status = SaddlePointSolution::Status::not_positive_definite;
  if (found.status == Reached::dependent_row)
    found.solution.status = SaddlePointSolution::Status::dependent_constraints;
  if (found.status == Reached::diverged || found.status == Reached::not_converged) {
    r.status = Status::not_converged;
    r.notes.push_back(trouble(found, spec));
  }
  r.linear = LinearRun{found.steps, found.factor, found.tau_border, std::move(found.history)};
  return std::move(found.solution);
}

}  // namespace mortise
