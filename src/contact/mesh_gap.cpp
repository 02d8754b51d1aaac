#include "contact/mesh_gap.hpp"

#include <algorithm>
#include <cmath>

namespace mortise {
namespace {

double angle(const Vec2& a, const Vec2& b) { return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b))); }

}  // namespace

std::vector<double> sagittas(const Points& nodes, const Curve& curve) {
  const std::size_t count = curve.edges.size();
  const auto tangent = [&](std::size_t e, double xi) { return edge_point(nodes, curve.edges[e], xi).tangent; };
  std::vector<double> list;
  for (std::size_t e = 0; e < count; ++e) {
    double turn = angle(tangent(e, -1), tangent(e, 1));
    if (e + 1 < count || curve.closed) turn = std::max(turn, angle(tangent(e, 0), tangent((e + 1) % count, 0)));
    if (e > 0 || curve.closed) turn = std::max(turn, angle(tangent((e + count - 1) % count, 0), tangent(e, 0)));
    list.push_back(edge_length(nodes, curve.edges[e]) * turn / 8);
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
    const auto e = std::size_t(p.edge), o = std::size_t(p.opposite_edge);
    const double limit = 2 * (sagitta[e] + opposite_sagitta[o]) + slack * std::max(length[e], opposite_length[o]);
    if (std::abs(p.gap) > limit && (!worst || std::abs(p.gap) - limit > std::abs(worst->gap) - worst->limit))
      worst = OpenPlace{edge_point(nodes, multiplier.edges[e], p.xi).position, p.gap, limit};
  }
  return worst;
}

}  // namespace mortise
