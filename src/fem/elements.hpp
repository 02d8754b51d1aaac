// Shape functions on reference cells and edges.
//
// Triangles: (0,0), (1,0), (0,1). Quadrilaterals: [-1,1]^2. Edges: [-1,1], nodes start, end, middle.
// Node order as in mesh/mesh.hpp.
#pragma once

#include <array>

#include "mesh/mesh.hpp"

namespace mortise {

/// Values N and reference gradients dN at a point of a cell; the first node_count(kind) rows are used.
struct CellShape {
  std::array<double, 9> N;
  std::array<Vec2, 9> dN;  ///< (d/dxi, d/deta)
};

CellShape cell_shape(CellKind kind, const Vec2& xi);

/// Reference coordinates of a cell's nodes: node_count(kind) x 2.
Points reference_nodes(CellKind kind);
Vec2 reference_centre(CellKind kind);

/// Values and derivatives d/dxi at a point of an edge; the first node_count are used, the rest are zero.
struct EdgeShape {
  std::array<double, 3> N{};
  std::array<double, 3> dN{};
};

EdgeShape edge_shape(int node_count, double xi);

/// Where an edge is at xi, and which way it goes.
struct EdgePoint {
  Vec2 position;
  Vec2 tangent;  ///< d position / d xi, length per unit of xi
  /// Unit normal on the right of the tangent: outward when the body lies on the left.
  Vec2 normal() const { return Vec2(tangent.y(), -tangent.x()).normalized(); }
  /// Length element ds / d xi.
  double jacobian() const { return tangent.norm(); }
};

EdgePoint edge_point(const Points& nodes, const Edge& edge, double xi);

/// Throws InputError naming the place if the Jacobian of a cell is not positive at its nodes and its centre: an
/// inverted or degenerate cell.
void check_cells(const Mesh& mesh);

}  // namespace mortise
