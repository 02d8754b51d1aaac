#include "results/large_displacement.hpp"

#include <algorithm>
#include <cmath>

#include "base/printable.hpp"
#include "results/line_motion.hpp"
#include "results/other_normals.hpp"

namespace mortise {
namespace {

constexpr double least_told = 0.01;  // of p, where no smaller accuracy is asked for

// What p is off by in L2, and why.
struct Largest {
  double part = 0;
  Vec2 position = Vec2::Zero();
  std::string why;

  void take(const Largest& other) {
    if (other.part > part) *this = other;
  }
};

struct LargestInContact {
  Largest worst;    // of the pair of which most is lost, by its part in the norm of all pressure
  double lost = 0;  // what p of all pairs is off by, as motion_check sums it
};

LargestInContact largest_in_contact(const Results& r, double least) {
  LargestInContact found;
  const std::vector<std::optional<OtherNormals>> others = other_normals(r, least);
  double most = 0, norm = 0, lost = 0;
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k) {
    const auto line = line_motion(r.problem.mesh.nodes, r.problem.pairs[k], r.recovery.contacts[k], r.solution.u);
    if (!line) continue;
    Largest of_pair;
    if (const auto& other = others[k])
      of_pair.take(
          {other->part, other->position,
           "the sides slide along one another where their normals differ by " + two_digits(other->angle) + " radians"});
    of_pair.take({line->shifted, line->slid_at,
                  "the sides slide along one another by " + percent(line->slid) +
                      " of the length in contact, all in one direction,"});
    of_pair.take({line->curved, line->position,
                  "the sides move against one another by " + percent(line->curved) + " of the contact line's radius"});
    of_pair.take({line->strained, line->position,
                  "the contact line turns and stretches so that " + percent(line->strained) + " of p is lost"});
    const double of_all = std::min(1., of_pair.part) * line->norm;
    norm = std::hypot(norm, line->norm);
    lost = std::hypot(lost, of_all);
    if (!(of_all > most)) continue;
    most = of_all;
    found.worst = of_pair;
  }
  if (norm > 0) found.lost = lost / norm;
  return found;
}

}  // namespace

LargeDisplacement large_displacement(const Results& r) {
  const Vec2 size = (r.problem.mesh.nodes.colwise().maxCoeff() - r.problem.mesh.nodes.colwise().minCoeff()).transpose();
  const double whole = largest_entry(r.solution.u) / size.norm();
  const double least = std::min(least_told, r.problem.accuracy.value_or(least_told));
  const auto [worst, lost] = largest_in_contact(r, least);
  LargeDisplacement found{lost, {}};
  if (lost > least)
    found.line = "large displacements: " + worst.why + " " + near_point(worst.position) +
                 "; contact is written on the undeformed bodies, so p may be off by " + percent(worst.part);
  else if (whole > 0.02)
    found.line = "large displacements: up to " + percent(whole) +
                 " of the size of the scene; the equations assume small displacements";
  return found;
}

}  // namespace mortise
