#include "results/large_displacement.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/printable.hpp"
#include "base/vectors.hpp"
#include "fem/edges.hpp"
#include "results/line_motion.hpp"

namespace mortise {
namespace {

// At how many of its ends contact ends within the curve: at one, it is half of an ellipse.
int ends_within(const ContactResults& contact) {
  const double round_off = 1e-9 * contact.length;
  if (contact.length_in_contact > contact.length - round_off) return 0;
  if (!contact.ends) return 2;
  return ((*contact.ends)[0] > round_off) + ((*contact.ends)[1] < contact.length - round_off);
}

// What p that falls to zero at both ends as an ellipse is off by in L2, shifted by a part of its width.
double of_ellipse(double shift) {
  return shift > 0 ? std::min(1., shift * std::sqrt(3 * std::max(1., 0.9 - std::log(shift)))) : 0;
}

// By how much an edge turns, radians.
double rotation(const Points& nodes, const VecX& u, const Edge& edge) {
  const Vec2 chord = (nodes.row(edge.nodes[1]) - nodes.row(edge.nodes[0])).transpose();
  return angle_between(chord, chord + u.segment<2>(2 * edge.nodes[1]) - u.segment<2>(2 * edge.nodes[0]));
}

// What p is off by at most, and why.
struct Largest {
  double part = 0;
  Vec2 position = Vec2::Zero();
  double shown = 0;
  const char *before = "", *after = "";

  void take(const Largest& other) {
    if (other.part > part) *this = other;
  }
};

Largest largest_in_contact(const Results& r) {
  Largest worst;
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k) {
    const ContactPair& pair = r.problem.pairs[k];
    const ContactResults& contact = r.recovery.contacts[k];
    if (contact.length_in_contact == 0) continue;
    const std::vector<double> curvature = edge_curvatures(r.problem.mesh.nodes, pair.multiplier),
                              opposite_curvature = edge_curvatures(r.problem.mesh.nodes, pair.opposite);
    for (const ContactPoint& c : pair.points) {
      if (!(interpolate(pair, contact.pressure, {c.edge, c.xi}) > 1e-3 * contact.p_max)) continue;
      const Edge &edge = pair.multiplier.edges[c.edge], &other = pair.opposite.edges[c.opposite_edge];
      const Vec2 x = edge_point(r.problem.mesh.nodes, edge, c.xi).position;
      const Vec2 moved = edge_value(r.solution.u, other, c.eta) - edge_value(r.solution.u, edge, c.xi);
      const double slip = std::abs(moved.x() * c.normal.y() - moved.y() * c.normal.x());
      const double curved = moved.norm() * std::max(curvature[c.edge], opposite_curvature[c.opposite_edge]),
                   along = slip / contact.length_in_contact,
                   turned = std::max(rotation(r.problem.mesh.nodes, r.solution.u, edge),
                                     rotation(r.problem.mesh.nodes, r.solution.u, other));
      worst.take(
          {curved, x, 100 * curved, "the sides move against one another by ", " % of the contact line's radius"});
      worst.take({along, x, 100 * along, "the sides slide along one another by ", " % of the length in contact"});
      worst.take({turned * turned, x, turned, "a side turns by ", " radians"});
    }
    const int within = ends_within(contact);
    if (within == 0) continue;  // p ends with the curve and moves with it
    if (const auto all = line_motion(r.problem.mesh.nodes, pair, contact, r.solution.u))
      worst.take({of_ellipse(all->slid * within / 2), all->position, 100 * all->slid,
                  "the sides slide along one another by ", " % of the length in contact, all in one direction,"});
  }
  return worst;
}

}  // namespace

std::optional<std::string> large_displacement(const Results& r) {
  std::ostringstream text;
  text.precision(2);
  const Vec2 size = (r.problem.mesh.nodes.colwise().maxCoeff() - r.problem.mesh.nodes.colwise().minCoeff()).transpose();
  const double whole = largest_entry(r.solution.u) / size.norm();
  if (const Largest worst = largest_in_contact(r); worst.part > 0.01)
    text << "large displacements: " << worst.before << worst.shown << worst.after << " " << near_point(worst.position)
         << "; contact is written on the undeformed bodies, so p may be off by " << 100 * worst.part << " %";
  else if (whole > 0.02)
    text << "large displacements: up to " << 100 * whole
         << " % of the size of the scene; the equations assume small displacements";
  else
    return {};
  return text.str();
}

}  // namespace mortise
