#include "contact/least_gap.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>

#include "fem/edges.hpp"

namespace mortise {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A place of the multiplier side as one number: the edge's index and the part of it before the place. Of a closed curve
// whole turns count for nothing.
double number_of(const ContactPoint& point) { return point.edge + (1 + point.xi) / 2; }

std::optional<ContactPoint> point_at(const Points& nodes, const ContactInterface& interface, double number) {
  const int edges = int(interface.multiplier.edges.size());
  if (interface.multiplier.closed) number -= edges * std::floor(number / edges);
  const int edge = std::clamp(int(number), 0, edges - 1);
  return contact_point(nodes, interface, edge, 2 * (number - edge) - 1);
}

Vec2 place_of(const Points& nodes, const ContactInterface& interface, const ContactPoint& point) {
  return edge_point(nodes, interface.multiplier.edges[point.edge], point.xi).position;
}

}  // namespace

Vec2 parted(const VecX& u, const ContactInterface& interface, const ContactPoint& point) {
  return edge_value(u, interface.opposite.edges[point.opposite_edge], point.eta) -
         edge_value(u, interface.multiplier.edges[point.edge], point.xi);
}

double opened(const Points& nodes, const std::vector<RigidMotion>& motion, const ContactInterface& interface,
              const ContactPoint& point) {
  const Vec2 x = place_of(nodes, interface, point),
             y = edge_point(nodes, interface.opposite.edges[point.opposite_edge], point.eta).position;
  Vec2 parted = Vec2::Zero();
  for (const RigidMotion& part : motion) {
    if (part.body == interface.multiplier.body) parted -= part.at(x);
    if (part.body == interface.opposite.body) parted += part.at(y);
  }
  return parted.dot(point.normal);
}

double gap_at(const VecX& u, const ContactInterface& interface, const ContactPoint& point) {
  return point.gap + parted(u, interface, point).dot(point.normal);
}

std::vector<Interval> gap_ranges(const VecX& u, const ContactInterface& interface) {
  std::vector<Interval> ranges(interface.multiplier.edges.size(), {infinity, -infinity});
  for (const ContactPoint& point : interface.points) {
    Interval& range = ranges[point.edge];
    const double gap = gap_at(u, interface, point);
    range = {std::min(range.low, gap), std::max(range.high, gap)};
  }
  return ranges;
}

std::vector<Trough> troughs(const Points& nodes, const VecX& u, const ContactInterface& interface,
                            const std::vector<char>& on) {
  const std::vector<ContactPoint>& points = interface.points;
  const bool closed = interface.multiplier.closed;
  const int count = int(points.size());
  const double edges = double(interface.multiplier.edges.size());
  VecX gap(count);
  for (int i = 0; i < count; ++i) gap(i) = gap_at(u, interface, points[i]);
  const auto gap_there = [&](double number) {
    const auto point = point_at(nodes, interface, number);
    return point ? gap_at(u, interface, *point) : infinity;
  };
  std::vector<Trough> found;
  for (int i = 0; i < count; ++i) {
    if (!on.empty() && !on[points[i].edge]) continue;
    const int before = closed ? (i + count - 1) % count : i - 1, after = closed ? (i + 1) % count : i + 1;
    const bool first = before < 0, last = after == count;
    if ((!first && gap(before) <= gap(i)) || (!last && gap(after) < gap(i))) continue;
    const double from = first ? 0 : number_of(points[before]) - (before > i ? edges : 0),
                 to = last ? edges : number_of(points[after]) + (after < i ? edges : 0);
    const int bits = std::numeric_limits<double>::digits / 2;  // of the place: at its least a gap shows no more
    const double number = boost::math::tools::brent_find_minima(gap_there, from, to, bits).first;
    std::optional<ContactPoint> point = point_at(nodes, interface, number);
    if (!point || !(gap_at(u, interface, *point) <= gap(i))) point = points[i];
    point->ds = point->dA = 0;
    double curvature = 0, least_curvature = infinity;
    for (const int beside : {before, after}) {
      if (beside < 0 || beside == count) continue;
      point->unknown = std::max(point->unknown, points[beside].unknown);
      const Vec2 apart = place_of(nodes, interface, points[beside]) - place_of(nodes, interface, *point);
      const double of_side = 2 * (gap(beside) - gap_at(u, interface, *point)) / apart.squaredNorm();
      curvature = std::max(curvature, of_side);
      least_curvature = std::min(least_curvature, of_side);
    }
    found.push_back({*point, curvature, least_curvature});
  }
  return found;
}

LeastGap least_gap(const Points& nodes, const VecX& u, const ContactInterface& interface) {
  LeastGap least{infinity, Vec2::Zero(), 0, 0};
  for (const ContactPoint& point : interface.points) {
    const double gap = gap_at(u, interface, point);
    least.approach = std::max(least.approach, point.gap - gap);
    if (gap >= least.gap) continue;
    least.gap = gap;
    least.place = place_of(nodes, interface, point);
    least.edge = edge_length(nodes, interface.multiplier.edges[point.edge]);
  }
  return least;
}

bool stays_open(const LeastGap& coarser, const LeastGap& finer, double round_off) {
  if (finer.approach <= round_off || std::isinf(finer.gap)) return true;
  return finer.gap > 0 && std::abs(finer.gap - coarser.gap) <= finer.gap / 2;
}

}  // namespace mortise
