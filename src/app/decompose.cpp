#include "app/decompose.hpp"

#include <sstream>

#include "base/errors.hpp"
#include "mesh/place.hpp"

namespace mortise {
namespace {

std::vector<char> unknowns_of(const Mesh& mesh, const std::vector<char>& bodies) {
  std::vector<char> member(2 * mesh.nodes.rows(), 0);
  for (const Cell& cell : mesh.cells)
    for (int a = 0; a < node_count(cell.kind); ++a)
      for (int c = 0; c < 2; ++c) member[2 * cell.nodes[a] + c] = bodies[cell.body];
  return member;
}

// What the iteration did not reach, and what would.
std::string trouble(const DdmSolution& d, const std::vector<RelaxationStep>& history, const DdmSpec& spec) {
  const Residuals& last = history.back().residuals;
  std::ostringstream text;
  text << "the interface iteration " << (d.status == DdmSolution::Status::diverged ? "diverges" : "did not converge")
       << ": after " << history.size() << " steps the residuals are " << last.kinematic << " (kinematic) and "
       << last.force << " (force), where " << spec.tolerance << " was asked for; a step multiplies them by "
       << d.factor;
  if (d.spectrum.largest > 0)
    text << "; the eigenvalues of the interface are " << d.spectrum.smallest << " ... " << d.spectrum.largest
         << ": beta converges below " << d.spectrum.largest_beta() << ", best at " << d.spectrum.best_beta();
  return text.str();
}

[[noreturn]] void refuse(const Scene& scene, const Results& r, const DdmSolution& d) {
  using Reached = DdmSolution::Status;
  if (d.status == Reached::dependent_row) {
    const bool one_side = scene.method.ddm.scheme == Scheme::neumann_dirichlet;
    throw InputError(scene.path + ": the bodies that take the displacement" +
                     (one_side ? "" : " (all, with scheme = \"" + to_string(scene.method.ddm.scheme) + "\")") +
                     " do not feel the multiplier " +
                     near_point(r.mesh.nodes.row(row_nodes(r.pairs)[d.solution.failed_at]).transpose()) +
                     ": expected contact.multipliers_on to name " +
                     (one_side ? "the curve of the body that takes the displacement (or the coarser curve)"
                               : "the coarser curve, or scheme = \"neumann_dirichlet\"") +
                     ", or method.kind = \"mortar\"");
  }
  if (d.status == Reached::unheld)
    throw InputError(scene.path +
                     ": contact opens until nothing holds a body; expected a load that presses it on, or prescribed "
                     "displacements that hold it (method.kind = \"mortar\" names the motion)");
  throw InputError(scene.path + ": method.scheme = \"" + to_string(scene.method.ddm.scheme) +
                   "\" is for bilateral contact, and contact pulls here; expected \"neumann_dirichlet\", or "
                   "contact.condition = \"bilateral\"");
}

}  // namespace

SaddlePointSolution decompose(const Scene& scene, const SaddlePointSystem& system, const std::vector<char>& dirichlet,
                              Results& r) {
  const DdmSpec& spec = scene.method.ddm;
  const DdmOptions options{spec.scheme, spec.acceleration.value_or(Acceleration::krylov), spec.beta, spec.tolerance,
                           spec.max_iterations};
  DdmSolution d = solve_by_ddm(system, unknowns_of(r.mesh, dirichlet), options);
  using Reached = DdmSolution::Status;
  if (d.status == Reached::not_positive_definite) {
    d.solution.status = SaddlePointSolution::Status::not_positive_definite;
    return std::move(d.solution);
  }
  if (d.status > Reached::not_positive_definite) refuse(scene, r, d);

  InterfaceRun run{{}, options.acceleration, d.beta, d.spectrum, d.factor, std::move(d.history)};
  for (std::size_t b = 0; b < dirichlet.size(); ++b)
    if (dirichlet[b]) run.dirichlet.push_back(r.mesh.bodies[b]);
  if (d.status != Reached::converged) {
    r.status = Status::not_converged;
    r.notes.push_back(trouble(d, run.history, spec));
  }
  r.interface = std::move(run);
  return std::move(d.solution);
}

}  // namespace mortise
