#include "results/large_displacement.hpp"

#include <algorithm>
#include <cmath>

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
  bool is_part = true;  // what is shown

  std::string amount() const { return is_part ? percent(shown) : two_digits(shown); }
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
      worst.take(
          {place.curved, x, place.curved, "the sides move against one another by ", " of the contact line's radius"});
      worst.take({along, x, along, "the sides slide along one another by ", " of the length in contact"});
      worst.take({place.turned * place.turned, x, place.turned, "a side turns by ", " radians", false});
    }
    if (const auto all = line_motion(r.problem.mesh.nodes, pair, contact, r.solution.u))
      worst.take({all->shifted, all->position, all->slid, "the sides slide along one another by ",
                  " of the length in contact, all in one direction,"});
  }
  return worst;
}

}  // namespace

std::optional<std::string> large_displacement(const Results& r) {
  const Vec2 size = (r.problem.mesh.nodes.colwise().maxCoeff() - r.problem.mesh.nodes.colwise().minCoeff()).transpose();
  const double whole = largest_entry(r.solution.u) / size.norm();
  if (const Largest worst = largest_in_contact(r); worst.part > 0.01)
    return "large displacements: " + (worst.before + worst.amount()) + worst.after + " " + near_point(worst.position) +
           "; contact is written on the undeformed bodies, so p may be off by " + percent(worst.part);
  if (whole > 0.02)
    return "large displacements: up to " + percent(whole) +
           " of the size of the scene; the equations assume small displacements";
  return {};
}

}  // namespace mortise
