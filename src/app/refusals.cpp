#include "app/refusals.hpp"

#include <sstream>

#include "base/errors.hpp"
#include "contact/mesh_gap.hpp"
#include "mesh/place.hpp"

namespace mortise {
namespace {

std::string near_node(const Mesh& mesh, int node) { return near_point(mesh.nodes.row(node).transpose()); }

// Rows of B over their size: what contact can hold.
SparseMatrix unit_rows(const StackedCoupling& coupling) {
  SparseMatrix rows = coupling.B;
  for (Eigen::Index k = 0; k < rows.nonZeros(); ++k) rows.valuePtr()[k] /= coupling.scale(rows.innerIndexPtr()[k]);
  return rows;
}

[[noreturn]] void fail_dependent(const Scene& scene, const Results& r, int row) {
  std::size_t k = 0;
  while (r.pairs[k].coupling.gap0.size() <= row) row -= int(r.pairs[k++].coupling.gap0.size());
  const Coupling& c = r.pairs[k].coupling;
  throw InputError(scene.path + ": " + r.pairs[k].spec.key + ": the contact condition " +
                   near_node(r.mesh, row_nodes(c)[std::size_t(row)]) +
                   " already follows from the others: prescribed displacements or other contact pairs hold the "
                   "same nodes; put the multipliers on the other curve or release the prescribed displacement");
}

[[noreturn]] void fail_unheld(const Scene& scene, const Results& r, const Floating& floating,
                              const SaddlePointSolution& solution) {
  const auto motion = motion_through(r.mesh, floating.motions, floating.grounded, solution.drift);
  throw InputError(
      scene.path + ": nothing holds " + describe(r.mesh, motion) + ": " +
      (solution.driven ? "the load moves it away from the contact" : "no load presses it onto the contact") +
      "; expected a load that presses it on, or prescribed displacements that hold it");
}

}  // namespace

Floating find_floating(const Mesh& mesh, const Constraints& constraints) {
  Floating floating;
  floating.motions = free_motions(mesh, constraints, SparseMatrix(0, 2 * mesh.nodes.rows()));
  floating.grounded = grounding_unknowns(mesh, constraints, floating.motions);
  return floating;
}

void require_held(const Scene& scene, const Mesh& mesh, const Constraints& constraints, const StackedCoupling& coupling,
                  const std::vector<std::string>& findings) {
  const auto motions = free_motions(mesh, constraints, unit_rows(coupling));
  if (motions.empty()) return;
  throw InputError(scene.path + ": nothing holds " + describe(mesh, motions.front()) +
                   "; expected prescribed displacements or contact that prevent it" +
                   (findings.empty() ? "" : ": " + findings.front()));
}

void require_closed(const Scene& scene, const Mesh& mesh, const std::vector<ContactPair>& pairs) {
  for (const ContactPair& pair : pairs) {
    if (pair.spec.initial_gap != InitialGap::closed) continue;
    const auto open = open_place(mesh.nodes, pair.multiplier, pair.opposite, pair.points);
    if (!open) continue;
    std::ostringstream text;
    text << scene.path << ": " << pair.spec.key << ".initial_gap = \"closed\", but '" << pair.spec.between[0]
         << "' and '" << pair.spec.between[1] << "' are " << open->gap << " apart " << near_point(open->position)
         << ", where two meshes of one curve differ by at most " << open->limit
         << "; expected initial_gap = \"measured\", or curves that are one curve";
    throw InputError(text.str());
  }
}

void require_solved(const Scene& scene, const Results& r, const Floating& floating,
                    const SaddlePointSolution& solution) {
  if (solution.status == SaddlePointSolution::Status::not_positive_definite)
    throw InputError(scene.path + ": the stiffness is not positive definite " +
                     near_node(r.mesh, solution.failed_at / 2) +
                     ": a part of a body that nothing holds, or elements far out of shape there");
  if (solution.status == SaddlePointSolution::Status::dependent_constraints)
    fail_dependent(scene, r, solution.failed_at);
  if (solution.status == SaddlePointSolution::Status::unheld) fail_unheld(scene, r, floating, solution);
}

}  // namespace mortise
