#include "app/notes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "contact/mesh_gap.hpp"
#include "contact/turns.hpp"
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

int degrees(double angle) { return int(std::lround(angle * 180 / std::numbers::pi)); }

// Both meshes must follow the contact line: its curvature, and its kinks (docs/stability.md, geometry).
void note_shape(const ContactPair& pair, Results& r) {
  const auto name = [&](const Curve& curve) { return "'" + r.mesh.boundaries[std::size_t(curve.boundary)].name + "'"; };
  for (const auto& [curve, other] :
       {std::pair{&pair.multiplier, &pair.opposite}, std::pair{&pair.opposite, &pair.multiplier}}) {
    const Turn sharpest = sharpest_edge(r.mesh.nodes, *curve);
    if (degrees(sharpest.angle) > 30)
      r.notes.push_back(pair.spec.key + ": an edge of " + name(*curve) + " " + near_point(sharpest.position) +
                        " turns by " + std::to_string(degrees(sharpest.angle)) +
                        " degrees: the mesh is coarse for the curve; expected at most 30");
    // A gap that is measured is meant: a corner may stand on a flat side.
    if (pair.spec.initial_gap != InitialGap::closed) continue;
    if (const auto kink = missed_kink(r.mesh.nodes, *curve, *other))
      r.notes.push_back(pair.spec.key + ": " + name(*curve) + " has a kink of " + std::to_string(degrees(kink->angle)) +
                        " degrees " + near_point(kink->position) + ", where " + name(*other) +
                        " has no vertex and cuts it short; expected a vertex of both meshes there");
  }
}

// Positions are rounded to this part of themselves.
constexpr double round_off = std::numeric_limits<double>::epsilon();

// A measured gap is a difference of positions: far from the origin it is round-off.
void note_far_from_origin(const ContactPair& pair, Results& r) {
  if (pair.spec.initial_gap != InitialGap::measured) return;
  const double farthest = r.mesh.nodes.cwiseAbs().maxCoeff();
  const double gap = std::max(std::abs(pair.coupling.gap_min), std::abs(pair.coupling.gap_max));
  const double size = std::max(gap, r.u.cwiseAbs().maxCoeff());
  if (round_off * farthest <= 1e-8 * size) return;
  std::ostringstream text;
  text << pair.spec.key << ": coordinates up to " << farthest << " are rounded to about " << round_off * farthest
       << ", where gaps and displacements are up to " << size << "; expected an origin near the bodies";
  r.notes.push_back(text.str());
}

// The equations are those of small displacements. A plate that turns or shifts as a whole counts too: its normals turn.
void note_large_displacement(Results& r) {
  const Vec2 size = (r.mesh.nodes.colwise().maxCoeff() - r.mesh.nodes.colwise().minCoeff()).transpose();
  const double largest = r.u.cwiseAbs().maxCoeff();
  if (largest <= 0.02 * size.norm()) return;
  std::ostringstream text;
  text << "displacements are up to " << largest << ", " << std::round(100 * largest / size.norm())
       << " % of the size of the whole: the equations are those of small displacements";
  r.notes.push_back(text.str());
}

// Poisson's ratio from which elements lock in plane strain: docs/stability.md, near incompressibility.
void note_locking(const Scene& scene, Results& r) {
  if (scene.plane != Plane::strain) return;
  for (const BodySpec& body : scene.bodies) {
    const double poisson = scene.materials.at(body.material).poisson;
    const int b = body_index(r.mesh, body.name);
    const bool linear = std::any_of(r.mesh.cells.begin(), r.mesh.cells.end(), [&](const Cell& cell) {
      return cell.body == b && (cell.kind == CellKind::tri3 || cell.kind == CellKind::quad4);
    });
    if (poisson < (linear ? 0.4 : 0.49)) continue;
    std::ostringstream text;
    text << "body '" << body.name << "' is nearly incompressible (poisson = " << poisson << "): its "
         << (linear ? "linear elements lock, displacements are too small"
                    : "stresses inside swing from element to element")
         << "; expected "
         << (linear ? "quadratic elements, or poisson < 0.4" : "6-node triangles and a finer mesh, or poisson < 0.49");
    r.notes.push_back(text.str());
  }
}

}  // namespace

void add_notes(const Scene& scene, const std::vector<int>& unsettled, Results& r) {
  note_unsettled(unsettled, r);
  note_large_displacement(r);
  note_locking(scene, r);
  for (const ContactPair& pair : r.pairs) {
    for (const DroppedMultiplier& d : pair.coupling.dropped)
      r.notes.push_back(pair.spec.key + ": multiplier " + near_node(r.mesh, d.node) + " " + d.reason);
    note_mesh_gap(pair, r);
    note_shape(pair, r);
    note_far_from_origin(pair, r);
  }
}

}  // namespace mortise
