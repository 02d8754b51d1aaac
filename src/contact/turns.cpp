#include "contact/turns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "contact/segments.hpp"

namespace mortise {
namespace {

constexpr double kink = 20 * std::numbers::pi / 180;

double angle_between(const Vec2& a, const Vec2& b) {
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

// Calls f(edge, next) for each pair of neighbours along the curve.
template <typename Function>
void for_neighbours(const Curve& curve, Function f) {
  for (std::size_t e = 0; e + 1 < curve.edges.size(); ++e) f(curve.edges[e], curve.edges[e + 1]);
  if (curve.closed) f(curve.edges.back(), curve.edges.front());
}

}  // namespace

Turn sharpest_edge(const Points& nodes, const Curve& curve) {
  Turn sharpest{0, Vec2::Zero()};
  const auto take = [&](const EdgePoint& from, const EdgePoint& to, const Vec2& position) {
    const double angle = angle_between(from.normal(), to.normal());
    if (angle > sharpest.angle) sharpest = {angle, position};
  };
  for (const Edge& edge : curve.edges)
    if (edge.node_count == 3)
      take(edge_point(nodes, edge, -1), edge_point(nodes, edge, 1), edge_point(nodes, edge, 0).position);
  for_neighbours(curve, [&](const Edge& edge, const Edge& next) {
    const EdgePoint from = edge_point(nodes, edge, 0), to = edge_point(nodes, next, 0);
    if (edge.node_count == 2 && angle_between(from.normal(), to.normal()) < kink)  // more is a kink, perhaps meant
      take(from, to, edge_point(nodes, edge, 1).position);
  });
  return sharpest;
}

std::optional<StraightSides> straight_sides(const Points& nodes, const Curve& curve) {
  StraightSides found{0, 0, Vec2::Zero()};
  for_neighbours(curve, [&](const Edge& edge, const Edge& next) {
    const EdgePoint before = edge_point(nodes, edge, 1), after = edge_point(nodes, next, -1);
    const double turn = angle_between(before.normal(), after.normal());
    const auto bend = [&](const Edge& e) {
      return angle_between(edge_point(nodes, e, -1).normal(), edge_point(nodes, e, 1).normal());
    };
    if (edge.node_count == 2 || turn < kink / 20 || turn > kink) return;
    if (std::max(bend(edge), bend(next)) > 0.1 * turn) return;
    ++found.vertices;
    const double sagitta = std::max(edge_length(nodes, edge), edge_length(nodes, next)) * turn / 8;
    if (sagitta > found.sagitta) found = {found.vertices, sagitta, before.position};
  });
  if (found.vertices < 3) return {};
  return found;
}

std::optional<Turn> missed_kink(const Points& nodes, const Curve& curve, const Curve& other) {
  std::optional<Turn> sharpest;
  for_neighbours(curve, [&](const Edge& edge, const Edge& next) {
    const EdgePoint before = edge_point(nodes, edge, 1), after = edge_point(nodes, next, -1);
    const double angle = angle_between(before.normal(), after.normal());
    if (edge.node_count == 2 || angle < kink || (sharpest && angle < sharpest->angle)) return;
    const double size = 0.01 * std::min(edge_length(nodes, edge), edge_length(nodes, next));
    double nearest = std::numeric_limits<double>::infinity();
    for (const Edge& facing : other.edges)
      for (const int node : {facing.nodes[0], facing.nodes[1]})
        nearest = std::min(nearest, (nodes.row(node).transpose() - before.position).norm());
    if (nearest > size) sharpest = Turn{angle, before.position};
  });
  return sharpest;
}

}  // namespace mortise
