// Quadrature rules on edges and cells.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace mortise {

/// Points in [-1, 1], weights summing to 2.
struct LineRule {
  std::vector<double> points;
  std::vector<double> weights;
};

/// Gauss-Legendre with n >= 1 points: exact for polynomials of degree 2n - 1.
LineRule gauss_legendre(int n);

/// Points of the reference cell, weights summing to its area (1/2 or 4).
struct CellRule {
  std::vector<Vec2> points;
  std::vector<double> weights;
};

/// The rule of the stiffness: 1 point on tri3, 3 on tri6, 2 x 2 on quad4, 3 x 3 on quad8 and quad9.
/// Exact for straight-sided triangles and for parallelograms (quad9 and quad8 alike).
CellRule cell_rule(CellKind kind);

/// Its number of points.
constexpr int cell_rule_size(CellKind kind) {
  switch (kind) {
    case CellKind::tri3:
      return 1;
    case CellKind::tri6:
      return 3;
    case CellKind::quad4:
      return 4;
    case CellKind::quad8:
    case CellKind::quad9:
      return 9;
  }
  return 0;  // no kind
}

/// The points where stresses of the kind are superconvergent (Barlow 1976): the centre of tri3 and quad4,
/// three interior points on tri6, 2 x 2 Gauss points on quad8 and quad9.
CellRule stress_points(CellKind kind);

/// n x n points: Gauss-Legendre on a quadrilateral, collapsed onto a triangle. For norms of errors.
CellRule product_rule(CellKind kind, int n);

}  // namespace mortise
