#include "results/large_displacement.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/printable.hpp"
#include "results/line_motion.hpp"

namespace mortise {
namespace {

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
    for (const PlaceMotion& place : place_motions(r.problem.mesh.nodes, pair, contact, r.solution.u)) {
      const Vec2& x = place.position;
      const double along = std::abs(place.slid) / contact.length_in_contact;
      worst.take({place.curved, x, 100 * place.curved, "the sides move against one another by ",
                  " % of the contact line's radius"});
      worst.take({along, x, 100 * along, "the sides slide along one another by ", " % of the length in contact"});
      worst.take({place.turned * place.turned, x, place.turned, "a side turns by ", " radians"});
    }
    if (const auto all = line_motion(r.problem.mesh.nodes, pair, contact, r.solution.u))
      worst.take({all->shifted, all->position, 100 * all->slid, "the sides slide along one another by ",
                  " % of the length in contact, all in one direction,"});
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
