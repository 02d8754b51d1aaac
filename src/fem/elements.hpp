// Shape functions on reference cells.
//
// Triangles: (0,0), (1,0), (0,1). Quadrilaterals: [-1,1]^2.
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

/// A point of a cell in space.
struct CellPoint {
  Vec2 x = Vec2::Zero();
  Eigen::Matrix2d x_xi = Eigen::Matrix2d::Zero();  ///< (i, j) = d x_j / d xi_i

  double jacobian() const { return x_xi(0, 0) * x_xi(1, 1) - x_xi(1, 0) * x_xi(0, 1); }
};

/// Slopes by differences from the first node: the cell's size, not its distance from the origin, rounds them.
inline CellPoint cell_point(const Points& nodes, const Cell& cell, const CellShape& shape) {
  CellPoint at;
  for (int a = 0; a < node_count(cell.kind); ++a) {
    at.x += shape.N[a] * nodes.row(cell.nodes[a]).transpose();
    at.x_xi += shape.dN[a] * (nodes.row(cell.nodes[a]) - nodes.row(cell.nodes[0]));
  }
  return at;
}

/// Reference coordinates of a cell's nodes: node_count(kind) x 2.
Points reference_nodes(CellKind kind);
Vec2 reference_centre(CellKind kind);

/// Throws InputError naming the place if the Jacobian of a cell is not positive at its nodes and its centre: an
/// inverted or degenerate cell.
void check_cells(const Mesh& mesh);

}  // namespace mortise
