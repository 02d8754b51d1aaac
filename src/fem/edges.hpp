// Edges and curves of a mesh as shapes: where they are at xi, which way they go, how long they are.
//
// Edges: xi in [-1, 1], nodes start, end, middle.
#pragma once

#include "mesh/curve.hpp"

namespace mortise {

/// The quadratic Lagrange polynomial of the node at -1, 0 or 1 (others at these), and its slope.
constexpr double lagrange(double at, double x) { return at == 0 ? 1 - x * x : x * (x + at) / 2; }
constexpr double lagrange_slope(double at, double x) { return at == 0 ? -2 * x : x + at / 2; }

/// Values and derivatives d/dxi at a point of an edge; the first node_count are used, the rest are zero.
struct EdgeShape {
  std::array<double, 3> N{};
  std::array<double, 3> dN{};
};

EdgeShape edge_shape(int node_count, double xi);

/// Position and direction of an edge at xi.
struct EdgePoint {
  Vec2 position;
  Vec2 tangent;  ///< d position / d xi, length per unit of xi
  /// Unit normal on the right of the tangent: outward when the body lies on the left.
  Vec2 normal() const { return Vec2(tangent.y(), -tangent.x()).normalized(); }
  /// Length element ds / d xi.
  double jacobian() const { return tangent.norm(); }
};

/// The tangent by differences from the start, as cell_point's slopes.
EdgePoint edge_point(const Points& nodes, const Edge& edge, double xi);

/// xi of an edge's node a: start, end, middle.
constexpr double xi_of_node(int a) { return a == 0 ? -1 : a == 1 ? 1 : 0; }

/// Value at xi of a field u with two unknowns a node, 2 x nodes.
Vec2 edge_value(const VecX& u, const Edge& edge, double xi);

/// Length of an edge from its start to xi; of an edge; of a curve.
double length_to(const Points& nodes, const Edge& edge, double xi);
double edge_length(const Points& nodes, const Edge& edge);
double curve_length(const Points& nodes, const Curve& curve);

/// Mean place of edges along their length.
Vec2 centre_of(const Points& nodes, const std::vector<Edge>& edges);

}  // namespace mortise
