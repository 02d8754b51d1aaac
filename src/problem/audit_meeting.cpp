#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/printable.hpp"
#include "problem/audit_lines.hpp"

namespace mortise {
namespace {

// What edges of one name see of those of another, together.
struct Meeting {
  double length = 0;
  std::vector<int> edges, facing;
};
using Names = std::pair<int, int>;  // boundaries; -1: unnamed

// What one body's edges see of another body.
struct Side {
  double length = 0;
  std::map<Names, Meeting> places;
};

// The longest first, those that are as long but for round-off by their names; not what corners see beside them.
std::vector<const Meeting*> in_order(const Side& side) {
  constexpr double beside = 0.01, round_off = 1e-9;
  std::vector<const Meeting*> list;
  for (const auto& [names, place] : side.places)
    if (place.length > beside * side.length) list.push_back(&place);
  std::ranges::stable_sort(list, std::ranges::greater(),
                           [&](const Meeting* m) { return std::round(m->length / (round_off * side.length)); });
  return list;
}

std::string line(const AuditedBodies& b, int first, int second, const Side& found) {
  std::ostringstream places, pairs;
  const char* before = "";
  for (const Meeting* m : in_order(found)) {
    places << before << near_point(middle_of(b, m->edges)) << " over a length of " << m->length << " ("
           << name_of(b, m->edges) << ", " << name_of(b, m->facing) << ")";
    pairs << before << advice(b, m->edges, m->facing);
    before = " and ";
    if (first == second) break;  // one advice for all
  }
  return two_bodies(b.mesh, first, second) + " meet " + places.str() +
         ", and no contact pair keeps them apart there: " + pairs.str();
}

}  // namespace

LineOfBodies meeting_lines(const AuditedBodies& b, const std::vector<Encounter>& encounters) {
  std::map<std::pair<int, int>, Side> found;  // of the first body's edges with the second
  for (const Encounter& e : encounters) {
    if (e.meets == 0) continue;
    const int first = b.outline.edges[e.edge].body, second = b.outline.pieces[e.piece].body;
    const double length = first == second ? e.meets / 2 : e.meets;  // both pieces of one body are looked at
    Side& side = found[{first, second}];
    Meeting& m = side.places[first == second ? Names{} : Names{main_name(b, {e.edge}), main_name(b, e.facing)}];
    side.length += length;
    m.length += length;
    m.edges.push_back(e.edge);
    m.facing.insert(m.facing.end(), e.facing.begin(), e.facing.end());
  }
  LineOfBodies lines;
  for (const auto& [bodies, m] : found) {  // both directions see the same: that of the larger length speaks
    const auto back = found.find({bodies.second, bodies.first});
    const double other = back == found.end() || bodies.first == bodies.second ? 0 : back->second.length;
    const bool first = bodies.first <= bodies.second;
    if (first ? other > (1 + 1e-6) * m.length : other * (1 + 1e-6) >= m.length) continue;
    lines[std::minmax(bodies.first, bodies.second)] = line(b, bodies.first, bodies.second, m);
  }
  return lines;
}

}  // namespace mortise
