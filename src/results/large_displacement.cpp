#include "results/large_displacement.hpp"

#include <algorithm>
#include <cmath>

#include "base/printable.hpp"
#include "results/line_motion.hpp"
#include "results/other_normals.hpp"
#include "results/slides_across_jumps.hpp"

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

struct LargestInContact {
  Largest worst;    // of the pair of which most is lost, by its part in the norm of all pressure
  double lost = 0;  // what p of all pairs is off by, as motion_check sums it
};

LargestInContact largest_in_contact(const Results& r) {
  LargestInContact found;
  const std::vector<ElasticLaw>& laws = r.problem.discretisation.laws;
  const std::vector<std::optional<OtherNormals>> others = other_normals(r);
  double most = 0, norm = 0, lost = 0;
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k) {
    const ContactPair& pair = r.problem.pairs[k];
    const ContactResults& contact = r.recovery.contacts[k];
    if (contact.length_in_contact == 0) continue;
    Largest of_pair;
    const std::vector<PlaceMotion> places = place_motions(r.problem.mesh.nodes, pair, contact, r.solution.u);
    for (const PlaceMotion& place : places) {
      const Vec2& x = place.position;
      const double along = std::abs(place.slid) / contact.length_in_contact;
      of_pair.take(
          {place.curved, x, place.curved, "the sides move against one another by ", " of the contact line's radius"});
      of_pair.take({along, x, along, "the sides slide along one another by ", " of the length in contact"});
      of_pair.take({place.turned * place.turned, x, place.turned, "a side turns by ", " radians", false});
    }
    const double modulus = contact_modulus(laws[pair.multiplier.body], laws[pair.opposite.body]);
    if (const auto at = slide_across_jumps(r.problem.mesh.nodes, pair, places, modulus))
      of_pair.take({at->part, at->position, at->slid, "the sides slide along one another by ",
                    " across a jump of curvature", false});
    if (others[k])
      of_pair.take(
          {others[k]->part, others[k]->position, others[k]->angle, "the sides' normals differ by ", " radians", false});
    const auto all = line_motion(r.problem.mesh.nodes, pair, contact, r.solution.u);
    if (!all) continue;
    of_pair.take({all->shifted, all->slid_at, all->slid, "the sides slide along one another by ",
                  " of the length in contact, all in one direction,"});
    const double of_all = std::min(1., of_pair.part) * all->norm;
    norm = std::hypot(norm, all->norm);
    lost = std::hypot(lost, of_all);
    if (!(of_all > most)) continue;
    most = of_all;
    found.worst = of_pair;
  }
  if (norm > 0) found.lost = lost / norm;
  return found;
}

}  // namespace

std::optional<std::string> large_displacement(const Results& r) {
  const Vec2 size = (r.problem.mesh.nodes.colwise().maxCoeff() - r.problem.mesh.nodes.colwise().minCoeff()).transpose();
  const double whole = largest_entry(r.solution.u) / size.norm();
  if (const auto [worst, lost] = largest_in_contact(r); lost > 0.01)
    return "large displacements: " + (worst.before + worst.amount()) + worst.after + " " + near_point(worst.position) +
           "; contact is written on the undeformed bodies, so p may be off by " + percent(worst.part);
  if (whole > 0.02)
    return "large displacements: up to " + percent(whole) +
           " of the size of the scene; the equations assume small displacements";
  return {};
}

}  // namespace mortise
