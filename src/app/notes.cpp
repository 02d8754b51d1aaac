#include "app/notes.hpp"

#include <algorithm>
#include <sstream>

#include "contact/mesh_gap.hpp"
#include "mesh/place.hpp"

namespace mortise {
namespace {

std::string near_node(const Mesh& mesh, int node) { return near_point(mesh.nodes.row(node).transpose()); }

void note_unsettled(const std::vector<int>& unsettled, Results& r) {
  if (unsettled.empty()) return;
  const std::vector<int> nodes = row_nodes(r.pairs);
  std::string places;
  for (std::size_t i = 0; i < std::min<std::size_t>(unsettled.size(), 5); ++i)
    places += (i > 0 ? ", " : "") + near_node(r.mesh, nodes[std::size_t(unsettled[i])]);
  if (unsettled.size() > 5) places += " and " + std::to_string(unsettled.size() - 5) + " more";
  r.notes.push_back("the active set did not settle in " + std::to_string(r.steps.size()) + " steps: contact " + places +
                    " still changes");
}

// Enforced, a gap that only the meshes make causes pressures of about E gap / h.
void note_mesh_gap(const ContactPair& pair, Results& r) {
  if (pair.spec.initial_gap != InitialGap::measured) return;
  const double gap = std::max(std::abs(pair.coupling.gap_min), std::abs(pair.coupling.gap_max));
  const double displacement = r.u.cwiseAbs().maxCoeff();
  if (gap < 1e-3 * displacement || open_place(r.mesh.nodes, pair.multiplier, pair.opposite, pair.points, 1e-6)) return;
  std::ostringstream text;
  text << pair.spec.key << ": the undeformed gap (up to " << gap
       << ") is nowhere more than two meshes of one curve show, but not small against the displacements (up to "
       << displacement << "); if the curves are one curve, set initial_gap = \"closed\"";
  r.notes.push_back(text.str());
}

}  // namespace

void add_notes(const std::vector<int>& unsettled, Results& r) {
  note_unsettled(unsettled, r);
  for (const ContactPair& pair : r.pairs) {
    for (const DroppedMultiplier& d : pair.coupling.dropped)
      r.notes.push_back(pair.spec.key + ": multiplier " + near_node(r.mesh, d.node) + " " + d.reason);
    note_mesh_gap(pair, r);
  }
}

}  // namespace mortise
