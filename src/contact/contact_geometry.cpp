#include "contact/contact_geometry.hpp"

namespace mortise {
namespace {

// How far an edge lies off its line, along n through a place on it: (line - x) . n, length.
double offset(const ContactLine& line, const Place& at, const Vec2& x, const Vec2& n) {
  const auto xi = line.crossing(at.edge, x, n, at.xi);
  return xi ? (line.at(at.edge, *xi).position - x).dot(n) : 0;
}

}  // namespace

Line ContactGeometry::line_from(const Points& nodes, const Curve& curve, const Place& at) const {
  Line line = mortise::line_from(nodes, curve, at.edge, at.xi);
  if (normals)
    if (const auto foot = multiplier->foot(at.edge, line.x, at.xi)) line.n = multiplier->at(at.edge, *foot).normal();
  return line;
}

double ContactGeometry::clearance_at(const Vec2& x, const Place& at) const {
  return clearance(x, s ? s->at(at.edge, at.xi) : 0);
}

double ContactGeometry::initial_gap(const Line& line, const Place& at, const Hit& hit) const {
  if (given) return (*given)(line.x, s ? s->at(at.edge, at.xi) : 0);
  if (!one_line.empty() && one_line[at.edge]) return clearance_at(line.x, at);
  double distance = hit.distance + clearance_at(line.x, at);
  if (gap)
    distance += offset(*opposite, {hit.edge, hit.xi}, line.x + hit.distance * line.n, line.n) -
                offset(*multiplier, at, line.x, line.n);
  return distance;
}

}  // namespace mortise
