#include "contact/projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/vectors.hpp"
#include "fem/edges.hpp"
#include "mesh/thickness.hpp"

namespace mortise {
namespace {

// Real roots of c0 + c1 x + c2 x^2, without cancellation. Returns how many.
int quadratic_roots(double c0, double c1, double c2, std::array<double, 2>& roots) {
  const double discriminant = c1 * c1 - 4 * c0 * c2;
  if (discriminant < 0 || (c1 == 0 && c2 == 0)) return 0;
  const double q = -(c1 + std::copysign(std::sqrt(discriminant), c1)) / 2;
  if (q == 0) {  // c1 = 0 and c0 c2 = 0
    roots[0] = 0;
    return 1;
  }
  roots[0] = c0 / q;
  if (std::abs(c2) <= 1e-14 * std::abs(q)) return 1;  // the other root is far away
  roots[1] = q / c2;
  return 2;
}

// Whether the line from a place on the edge along n leaves the edge's body within `depth`, before it gets to x: then x
// lies outside that body, which hides the face from it. On the outline, as corners of two bodies on one side face are,
// it does not.
bool is_hidden(const Curve& curve, const Edge& edge, const EdgePoint& place, const Vec2& n, double depth) {
  return curve.outline &&
         curve.outline->way_out(edge, place.position, n, depth) < depth - projection_tolerance * place.jacobian();
}

// The next edge that the line may meet. The offset from the line changes by no more than the way along the curve, so
// edges whose control polygons end nearer to the end of this one than its offset lie on one side of the line, by the
// margin of project_onto_edge.
int next_within_reach(const Points& nodes, const Curve& curve, int edge, const Line& line) {
  if (curve.along.empty()) return edge + 1;
  const double offset = std::abs(cross(nodes.row(curve.edges[edge].nodes[1]).transpose() - line.x, line.n));
  const double reach = curve.along[edge + 1] + offset / (1 + 10 * projection_tolerance);
  return int(std::upper_bound(curve.along.begin() + edge + 2, curve.along.end(), reach) - curve.along.begin()) - 1;
}

}  // namespace

double deepest_overlap(const Curve& curve, int edge) {
  return curve.thickness.empty() ? std::numeric_limits<double>::infinity() : curve.thickness[edge] / 2;
}

Line line_from(const Points& nodes, const Curve& curve, int edge, double xi) {
  const EdgePoint p = edge_point(nodes, curve.edges[edge], xi);
  return {p.position, p.normal(), deepest_overlap(curve, edge)};
}

std::optional<Hit> project_onto_edge(const Points& nodes, const Curve& curve, int edge, const Line& line) {
  const auto& [x, n, depth] = line;
  const Edge& e = curve.edges[edge];
  // Offsets from the line at start, end and middle, and the polynomial through them.
  const double start = cross(nodes.row(e.nodes[0]).transpose() - x, n);
  const double end = cross(nodes.row(e.nodes[1]).transpose() - x, n);
  const double middle = e.node_count == 3 ? cross(nodes.row(e.nodes[2]).transpose() - x, n) : (start + end) / 2;
  // Bernstein coefficients of one sign: no root on the edge (with a margin for projection_tolerance).
  const double bulge = 2 * middle - (start + end) / 2;
  const double margin = 4 * projection_tolerance * (std::abs(end - start) + std::abs(bulge - start));
  if ((start > margin && end > margin && bulge > margin) || (start < -margin && end < -margin && bulge < -margin))
    return {};

  std::array<double, 2> roots{};
  const int count = quadratic_roots(middle, (end - start) / 2, (start + end) / 2 - middle, roots);
  std::optional<Hit> best;
  for (int i = 0; i < count; ++i) {
    const double xi = roots[i];
    if (std::abs(xi) > 1 + projection_tolerance) continue;
    const EdgePoint p = edge_point(nodes, e, xi);
    if (p.normal().dot(n) >= 0) continue;
    const double distance = (p.position - x).dot(n);
    if (-distance > std::min(depth, deepest_overlap(curve, edge))) continue;
    if (distance < 0 && is_hidden(curve, e, p, n, -distance)) continue;
    if (!best || std::abs(distance) < std::abs(best->distance)) best = Hit{edge, xi, distance};
  }
  return best;
}

std::optional<Hit> project_onto_curve(const Points& nodes, const Curve& curve, const Line& line) {
  std::optional<Hit> best;
  for (int edge = 0; edge < int(curve.edges.size()); edge = next_within_reach(nodes, curve, edge, line)) {
    const std::optional<Hit> hit = project_onto_edge(nodes, curve, edge, line);
    if (hit && (!best || std::abs(hit->distance) < std::abs(best->distance))) best = hit;
  }
  return best;
}

std::optional<double> foot_on_edge(const Points& nodes, const Edge& edge, const Vec2& x) {
  const auto offset = [&](double xi) {  // (x - edge(xi)) . edge'(xi)
    const EdgePoint p = edge_point(nodes, edge, xi);
    return (x - p.position).dot(p.tangent);
  };
  const Vec2 curvature =
      edge.node_count == 3
          ? Vec2((nodes.row(edge.nodes[0]) + nodes.row(edge.nodes[1]) - 2 * nodes.row(edge.nodes[2])).transpose())
          : Vec2::Zero();  // edge''
  double xi = 0;
  for (int step = 0; step < 20 && std::abs(xi) < 2; ++step) {
    const EdgePoint p = edge_point(nodes, edge, xi);
    const Vec2 away = x - p.position;
    const double change = away.dot(p.tangent) / (p.tangent.squaredNorm() - away.dot(curvature));
    xi += change;
    if (std::abs(change) < 1e-15) break;
  }
  if (std::abs(xi) < 1 && std::abs(offset(xi)) <= 1e-12 * edge_point(nodes, edge, xi).tangent.squaredNorm()) return xi;

  double low = -1, high = 1;  // the offset falls from positive to negative where the foot lies inside
  if (offset(low) <= 0 || offset(high) >= 0) return {};
  while (high - low > 1e-15) {
    xi = (low + high) / 2;
    if (xi == low || xi == high) break;
    (offset(xi) > 0 ? low : high) = xi;
  }
  return xi;
}

}  // namespace mortise
