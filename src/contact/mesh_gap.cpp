#include "contact/mesh_gap.hpp"

#include <algorithm>
#include <cmath>

namespace mortise {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
double angle(const Vec2& a, const Vec2& b) { return std::abs(std::atan2(cross(a, b), a.dot(b))); }

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
    const double kink = count == 1
                            ? angle(p.start, p.end)  // no neighbour tells: as if the edge were straight
                            : std::max(before != e ? angle(b.end, p.start) : 0, after != e ? angle(p.end, a.start) : 0);
    double cubic = 0;
    if (curve.edges[e].node_count == 3 && count > 1) {
      const double apart = (before != e ? (b.h + p.h) / 2 : 0) + (after != e ? (p.h + a.h) / 2 : 0);
      const double change = (a.curvature - b.curvature) / apart;
      cubic = std::abs(change * p.h * p.h / 24 - p.curvature * p.ahead) * p.h / (3 * std::sqrt(3));
    }
    list.push_back(p.h * kink / 8 + cubic);
  }
  return list;
}

std::optional<OpenPlace> open_place(const Points& nodes, const Curve& multiplier, const Curve& opposite,
                                    std::span<const ContactPoint> points, double slack) {
  const std::vector<double> sagitta = sagittas(nodes, multiplier), opposite_sagitta = sagittas(nodes, opposite);
  std::vector<double> length, opposite_length;
  for (const Edge& edge : multiplier.edges) length.push_back(edge_length(nodes, edge));
  for (const Edge& edge : opposite.edges) opposite_length.push_back(edge_length(nodes, edge));
  std::optional<OpenPlace> worst;
  for (const ContactPoint& p : points) {
    const int e = p.edge, o = p.opposite_edge;
    const double limit = 2 * (sagitta[e] + opposite_sagitta[o]) + slack * std::max(length[e], opposite_length[o]);
    if (std::abs(p.gap) > limit && (!worst || std::abs(p.gap) - limit > std::abs(worst->gap) - worst->limit))
      worst = OpenPlace{edge_point(nodes, multiplier.edges[e], p.xi).position, p.gap, limit};
  }
  return worst;
}

}  // namespace mortise
