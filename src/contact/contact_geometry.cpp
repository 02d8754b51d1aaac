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

double ContactGeometry::initial_gap(const Line& line, const Place& at, const Hit& hit) const {
  const double along = s ? s->at(at.edge, at.xi) : 0;
  if (given) return (*given)(line.x, along);
  double distance = hit.distance + clearance(line.x, along);
  if (gap)
    distance += offset(*opposite, {hit.edge, hit.xi}, line.x + hit.distance * line.n, line.n) -
                offset(*multiplier, at, line.x, line.n);
  return distance;
}

}  // namespace mortise
