#include <sstream>

#include "base/printable.hpp"
#include "problem/audit_lines.hpp"

namespace mortise {
namespace {

// What the edges of one body see of another, together.
struct Meeting {
  double length = 0;
  std::vector<int> edges, facing;
};

std::string line(const AuditedBodies& b, int first, int second, const Meeting& found) {
  std::ostringstream text;
  text << two_bodies(b.mesh, first, second) << " meet " << near_point(middle_of(b, found.edges)) << " over a length of "
       << found.length << " (" << name_of(b, found.edges) << ", " << name_of(b, found.facing)
       << "), and no contact pair keeps them apart there: " << advice(b, found.edges, found.facing);
  return text.str();
}

}  // namespace

LineOfBodies meeting_lines(const AuditedBodies& b, const std::vector<Encounter>& encounters) {
  std::map<std::pair<int, int>, Meeting> found;  // of the first body's edges with the second
  for (const Encounter& e : encounters) {
    if (e.meets == 0) continue;
    const int first = b.outline.edges[e.edge].body, second = b.outline.pieces[e.piece].body;
    Meeting& m = found[{first, second}];
    m.length += first == second ? e.meets / 2 : e.meets;  // both pieces of one body are looked at
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
