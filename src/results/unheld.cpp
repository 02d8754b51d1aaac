#include "results/unheld.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "contact/least_gap.hpp"

namespace mortise {
namespace {

constexpr double moves = 1e-6;  // of a motion of unit size; less is its round-off

// The first such motion of the body, in words.
std::string motion_words(const Results& r, int body) {
  for (const std::vector<RigidMotion>& motion : r.unheld)
    if (std::ranges::any_of(motion, [&](const RigidMotion& part) { return part.body == body; }))
      return describe(r.problem.mesh, motion);
  return "";
}

std::string direction(const std::array<bool, 2>& unheld) {
  return unheld[0] && unheld[1] ? "along x and y" : unheld[0] ? "along x" : "along y";
}

int body_of(const Results& r, const ProbeValue& value) { return r.problem.mesh.cells[value.place.in.cell].body; }

}  // namespace

std::array<bool, 2> unheld_at(const Results& r, int body, const Vec2& x) {
  std::array<bool, 2> unheld{};
  for (const std::vector<RigidMotion>& motion : r.unheld)
    for (const RigidMotion& part : motion) {
      if (part.body != body) continue;
      const Vec2 moved = part.at(x);
      for (const int c : {0, 1}) unheld[c] = unheld[c] || std::abs(moved(c)) > moves;
    }
  return unheld;
}

bool is_gap_held(const Results& r, const ContactPair& pair) {
  if (r.unheld.empty() || pair.points.empty()) return true;
  const VecX& u = r.solution.u;
  const ContactPoint& nearest =
      *std::ranges::min_element(pair.points, {}, [&](const ContactPoint& point) { return gap_at(u, pair, point); });
  return std::ranges::none_of(r.unheld, [&](const std::vector<RigidMotion>& motion) {
    return std::abs(opened(r.problem.mesh.nodes, motion, pair, nearest)) > moves;
  });
}

std::vector<std::string> unheld_probes(const Results& r) {
  std::vector<std::string> lines;
  std::set<int> told;
  for (const ProbeValue& value : r.recovery.probes) {
    const std::array<bool, 2> unheld = unheld_at(r, body_of(r, value), value.place.x);
    if (!(unheld[0] || unheld[1]) || !told.insert(value.place.probe).second) continue;
    lines.push_back(value.place.key + ": the displacement " + direction(unheld) + " " + near_point(value.place.x) +
                    " is undetermined and has no bar: nothing holds " + motion_words(r, body_of(r, value)));
  }
  return lines;
}

void require_held(const Results& r, const AccuracySpec& spec) {
  if (spec.of != Goal::displacement) return;
  for (int b = 0; b < int(r.problem.mesh.bodies.size()); ++b) {
    if (!spec.body.empty() && r.problem.mesh.bodies[b] != spec.body) continue;
    const std::array<bool, 2> unheld = unheld_at(r, b, spec.at);
    if (!(unheld[0] || unheld[1]) || !locate(r.problem.mesh, b, spec.at)) continue;
    throw SceneError(worded("accuracy.at: (", spec.at.x(), ", ", spec.at.y(), "): the displacement ", direction(unheld),
                            " is undetermined: nothing holds ", motion_words(r, b),
                            "; expected a support that does, or another quantity in accuracy.of"));
  }
}

void leave_out_unheld(Results& r) {
  if (r.unheld.empty()) return;
  for (ProbeValue& value : r.recovery.probes) {
    if (!value.error) continue;
    const std::array<bool, 2> unheld = unheld_at(r, body_of(r, value), value.place.x);
    for (const int c : {0, 1})
      if (unheld[c]) value.error->u(c) = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace mortise
