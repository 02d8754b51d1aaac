#include "fem/edges.hpp"

#include "fem/quadrature.hpp"

namespace mortise {
EdgeShape edge_shape(int node_count, double xi) {
  if (node_count == 2) return {{(1 - xi) / 2, (1 + xi) / 2, 0}, {-0.5, 0.5, 0}};
  return {{lagrange(-1, xi), lagrange(1, xi), lagrange(0, xi)},
          {lagrange_slope(-1, xi), lagrange_slope(1, xi), lagrange_slope(0, xi)}};
}

EdgePoint edge_point(const Points& nodes, const Edge& edge, double xi) {
  const EdgeShape s = edge_shape(edge.node_count, xi);
  EdgePoint p{Vec2::Zero(), Vec2::Zero()};
  for (int a = 0; a < edge.node_count; ++a) {
    p.position += s.N[a] * nodes.row(edge.nodes[a]).transpose();
    p.tangent += s.dN[a] * (nodes.row(edge.nodes[a]) - nodes.row(edge.nodes[0])).transpose();
  }
  return p;
}

Vec2 edge_value(const VecX& u, const Edge& edge, double xi) {
  const EdgeShape s = edge_shape(edge.node_count, xi);
  Vec2 value = Vec2::Zero();
  for (int a = 0; a < edge.node_count; ++a) value += s.N[a] * u.segment<2>(2 * edge.nodes[a]);
  return value;
}

double length_to(const Points& nodes, const Edge& edge, double xi) {
  static const LineRule rule = gauss_legendre(8);
  const double half = (xi + 1) / 2;
  const Vec2 start = nodes.row(edge.nodes[0]), end = nodes.row(edge.nodes[1]).transpose() - start;
  const Vec2 middle = edge.node_count == 3 ? Vec2(nodes.row(edge.nodes[2]).transpose() - start) : Vec2::Zero();
  double length = 0;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const EdgeShape s = edge_shape(edge.node_count, -1 + half * (1 + rule.points[q]));
    length += rule.weights[q] * half * (s.dN[1] * end + s.dN[2] * middle).norm();
  }
  return length;
}

double edge_length(const Points& nodes, const Edge& edge) { return length_to(nodes, edge, 1); }

double curve_length(const Points& nodes, const Curve& curve) {
  double length = 0;
  for (const Edge& edge : curve.edges) length += edge_length(nodes, edge);
  return length;
}

Vec2 centre_of(const Points& nodes, const std::vector<Edge>& edges) {
  Vec2 sum = Vec2::Zero();
  double length = 0;
  const LineRule rule = gauss_legendre(2);
  for (const Edge& edge : edges)
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const EdgePoint p = edge_point(nodes, edge, rule.points[q]);
      sum += rule.weights[q] * p.jacobian() * p.position;
      length += rule.weights[q] * p.jacobian();
    }
  return sum / length;
}

}  // namespace mortise
