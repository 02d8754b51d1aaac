#include "contact/curve_resolution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/vectors.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// An edge as its curve meets it: a piece of length h with its curvature at the middle, whose middle node lies `ahead`
// of halfway along it.
struct Piece {
  double h, curvature, ahead;
  Vec2 start, end;  // tangents
};

Piece piece_of(const Points& nodes, const Edge& edge) {
  const EdgePoint middle = edge_point(nodes, edge, 0);
  const Vec2 start = edge_point(nodes, edge, -1).tangent, end = edge_point(nodes, edge, 1).tangent;
  const Vec2& t = middle.tangent;       // half of the way from end to end
  const Vec2 bend = (end - start) / 2;  // second derivative; twice the way from the middle node back to halfway
  const double half = t.norm();
  return {2 * half, cross(t, bend) / (half * half * half), -bend.dot(t) / (2 * half), start, end};
}

constexpr double kink = 20 * std::numbers::pi / 180;

// Calls f(edge, next) for each pair of neighbours along the curve.
template <typename Function>
void for_neighbours(const Curve& curve, Function f) {
  for (std::size_t e = 0; e + 1 < curve.edges.size(); ++e) f(curve.edges[e], curve.edges[e + 1]);
  if (curve.closed) f(curve.edges.back(), curve.edges.front());
}

}  // namespace

std::vector<double> sagittas(const Points& nodes, const Curve& curve) {
  std::vector<Piece> pieces;
  for (const Edge& edge : curve.edges) pieces.push_back(piece_of(nodes, edge));
  const std::size_t count = pieces.size();
  std::vector<double> list;
  for (std::size_t e = 0; e < count; ++e) {
    const std::size_t before = e > 0 ? e - 1 : curve.closed ? count - 1 : e;
    const std::size_t after = e + 1 < count ? e + 1 : curve.closed ? 0 : e;
    const Piece &p = pieces[e], &b = pieces[before], &a = pieces[after];
    const double turn = count == 1 ? angle_between(p.start, p.end)  // no neighbour tells: as if the edge were straight
                                   : std::max(before != e ? angle_between(b.end, p.start) : 0,
                                              after != e ? angle_between(p.end, a.start) : 0);
    double cubic = 0;
    if (curve.edges[e].node_count == 3 && count > 1) {
      const double apart = (before != e ? (b.h + p.h) / 2 : 0) + (after != e ? (p.h + a.h) / 2 : 0);
      const double change = (a.curvature - b.curvature) / apart;
      cubic = std::abs(change * p.h * p.h / 24 - p.curvature * p.ahead) * p.h / (3 * std::sqrt(3));
    }
    list.push_back(p.h * turn / 8 + cubic);
  }
  return list;
}

double one_curve_gap(double sagitta, double other_sagitta, double longer_edge, double slack) {
  return 2 * (sagitta + other_sagitta) + slack * longer_edge;
}

std::optional<OpenPlace> open_place(const Points& nodes, const ContactInterface& interface, double slack) {
  const Curve &multiplier = interface.multiplier, &opposite = interface.opposite;
  const std::vector<double> sagitta = sagittas(nodes, multiplier), opposite_sagitta = sagittas(nodes, opposite);
  std::vector<double> length, opposite_length;
  for (const Edge& edge : multiplier.edges) length.push_back(edge_length(nodes, edge));
  for (const Edge& edge : opposite.edges) opposite_length.push_back(edge_length(nodes, edge));
  std::optional<OpenPlace> worst;
  for (const ContactPoint& p : interface.points) {
    const int e = p.edge, o = p.opposite_edge;
    const double limit = one_curve_gap(sagitta[e], opposite_sagitta[o], std::max(length[e], opposite_length[o]), slack);
    if (std::abs(p.gap) > limit && (!worst || std::abs(p.gap) - limit > std::abs(worst->gap) - worst->limit))
      worst = OpenPlace{edge_point(nodes, multiplier.edges[e], p.xi).position, p.gap, limit};
  }
  return worst;
}

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
