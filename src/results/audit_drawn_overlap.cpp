#include <algorithm>
#include <map>
#include <sstream>

#include "base/printable.hpp"
#include "base/vectors.hpp"
#include "contact/curve_resolution.hpp"
#include "fem/edges.hpp"
#include "results/audit_solution.hpp"

namespace mortise {
namespace {

// Two bodies that press an overlap apart deform by as much between them, however unlike they are. Where they deform by
// less than a tenth of it, it was undone by moving one of them as a whole.
constexpr double many_times = 10;

Vec2 at(const Results& r, int node) { return r.problem.mesh.nodes.row(node).transpose(); }

// The largest displacement of a body's nodes but for a motion of the whole: the translation and the small turn about
// the middle that are nearest in least squares.
double deformed_by(const Results& r, int body) {
  const int first = r.problem.points.first[body], end = r.problem.points.first[body + 1];
  Vec2 centre = Vec2::Zero(), mean = Vec2::Zero();
  for (int p = first; p < end; ++p) {
    centre += at(r, r.problem.points.node[p]) / (end - first);
    mean += r.solution.u.segment<2>(2 * r.problem.points.node[p]) / (end - first);
  }
  double turning = 0, inertia = 0;
  for (int p = first; p < end; ++p) {
    const Vec2 arm = at(r, r.problem.points.node[p]) - centre;
    turning += cross(arm, r.solution.u.segment<2>(2 * r.problem.points.node[p]) - mean);
    inertia += arm.squaredNorm();
  }
  const double turn = inertia > 0 ? turning / inertia : 0;
  double largest = 0;
  for (int p = first; p < end; ++p) {
    const Vec2 arm = at(r, r.problem.points.node[p]) - centre;
    const Vec2 whole = mean + turn * Vec2(-arm.y(), arm.x());
    largest = std::max(largest, (r.solution.u.segment<2>(2 * r.problem.points.node[p]) - whole).norm());
  }
  return largest;
}

// As drawn, not by a mesh: curves that a .geo draws are known to round-off, others as well as their edges follow them.
bool is_overlapped(const Results& r, const ContactPair& pair) {
  const InitialGap gap = pair.spec.initial_gap;
  if (gap != InitialGap::curve && gap != InitialGap::measured) return false;
  if (!is_drawn(pair) && !open_place(r.problem.mesh.nodes, pair, 1e-6)) return false;
  return pair.coupling.gap_min < -1e-9 * curve_length(r.problem.mesh.nodes, pair.multiplier);
}

// `deformed`: what both bodies deform by.
std::string line(const Results& r, const ContactPair& pair, double deformed) {
  const ContactPoint& deepest = *std::ranges::min_element(pair.points, {}, &ContactPoint::gap);
  const Vec2 place = edge_point(r.problem.mesh.nodes, pair.multiplier.edges[deepest.edge], deepest.xi).position;
  std::ostringstream text;
  text.precision(3);
  text << pair.spec.key << ": '" << pair.spec.between[0] << "' and '" << pair.spec.between[1]
       << "' are drawn into one another by " << -pair.coupling.gap_min << " " << near_point(place) << ", "
       << -pair.coupling.gap_min / deformed
       << " times the bodies' deformation: too much for an interference, which a body leaves as a whole; "
          "expected bodies drawn touching";
  return text.str();
}

}  // namespace

std::vector<std::string> drawn_overlap_lines(const Results& r) {
  std::vector<std::string> lines;
  std::map<int, double> deformed;
  const auto of = [&](int body) {
    const auto [found, is_new] = deformed.try_emplace(body, 0);
    if (is_new) found->second = deformed_by(r, body);
    return found->second;
  };
  for (const ContactPair& pair : r.problem.pairs) {
    if (!is_overlapped(r, pair)) continue;
    const double both = of(pair.multiplier.body) + of(pair.opposite.body);
    if (-pair.coupling.gap_min > many_times * both) lines.push_back(line(r, pair, both));
  }
  return lines;
}

}  // namespace mortise
