#include "contact/least_gap.hpp"

#include <cmath>
#include <limits>

#include "fem/edges.hpp"

namespace mortise {

LeastGap least_gap(const Points& nodes, const VecX& u, const ContactInterface& interface) {
  const Curve &multiplier = interface.multiplier, &opposite = interface.opposite;
  const std::vector<ContactPoint>& points = interface.points;
  LeastGap least{std::numeric_limits<double>::infinity(), Vec2::Zero(), 0, 0};
  for (const ContactPoint& point : points) {
    const Edge& edge = multiplier.edges[point.edge];
    const Vec2 apart = edge_value(u, opposite.edges[point.opposite_edge], point.eta) - edge_value(u, edge, point.xi);
    const double opening = apart.dot(point.normal);
    least.approach = std::max(least.approach, -opening);
    if (point.gap + opening >= least.gap) continue;
    least.gap = point.gap + opening;
    least.place = edge_point(nodes, edge, point.xi).position;
    least.edge = edge_length(nodes, edge);
  }
  return least;
}

bool stays_open(const LeastGap& coarser, const LeastGap& finer, double round_off) {
  if (finer.approach <= round_off || std::isinf(finer.gap)) return true;
  return finer.gap > 0 && std::abs(finer.gap - coarser.gap) <= finer.gap / 2;
}

}  // namespace mortise
