#include "fem/elements.hpp"

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// Quadrilateral corners and side middles in node order.
constexpr std::array<double, 9> quad_xi{-1, 1, 1, -1, 0, 1, 0, -1, 0};
constexpr std::array<double, 9> quad_eta{-1, -1, 1, 1, -1, 0, 1, 0, 0};

CellShape triangle_3(double x, double y) {
  CellShape s;
  s.N = {1 - x - y, x, y};
  s.dN[0] = {-1, -1};
  s.dN[1] = {1, 0};
  s.dN[2] = {0, 1};
  return s;
}

CellShape triangle_6(double x, double y) {
  const double z = 1 - x - y;
  CellShape s;
  s.N = {z * (2 * z - 1), x * (2 * x - 1), y * (2 * y - 1), 4 * z * x, 4 * x * y, 4 * y * z};
  s.dN[0] = {1 - 4 * z, 1 - 4 * z};
  s.dN[1] = {4 * x - 1, 0};
  s.dN[2] = {0, 4 * y - 1};
  s.dN[3] = {4 * (z - x), -4 * x};
  s.dN[4] = {4 * y, 4 * x};
  s.dN[5] = {-4 * y, 4 * (z - y)};
  return s;
}

CellShape quadrilateral_4(double x, double y) {
  CellShape s;
  for (std::size_t a = 0; a < 4; ++a) {
    const double xa = quad_xi[a], ya = quad_eta[a];
    s.N[a] = (1 + xa * x) * (1 + ya * y) / 4;
    s.dN[a] = {xa * (1 + ya * y) / 4, ya * (1 + xa * x) / 4};
  }
  return s;
}

CellShape quadrilateral_8(double x, double y) {
  CellShape s;
  for (std::size_t a = 0; a < 4; ++a) {
    const double xa = quad_xi[a], ya = quad_eta[a];
    s.N[a] = (1 + xa * x) * (1 + ya * y) * (xa * x + ya * y - 1) / 4;
    s.dN[a] = {xa * (1 + ya * y) * (2 * xa * x + ya * y) / 4, ya * (1 + xa * x) * (xa * x + 2 * ya * y) / 4};
  }
  for (std::size_t a = 4; a < 8; ++a) {
    const double xa = quad_xi[a], ya = quad_eta[a];
    if (xa == 0) {
      s.N[a] = (1 - x * x) * (1 + ya * y) / 2;
      s.dN[a] = {-x * (1 + ya * y), ya * (1 - x * x) / 2};
    } else {
      s.N[a] = (1 + xa * x) * (1 - y * y) / 2;
      s.dN[a] = {xa * (1 - y * y) / 2, -y * (1 + xa * x)};
    }
  }
  return s;
}

CellShape quadrilateral_9(double x, double y) {
  CellShape s;
  for (std::size_t a = 0; a < 9; ++a) {
    const double xa = quad_xi[a], ya = quad_eta[a];
    s.N[a] = lagrange(xa, x) * lagrange(ya, y);
    s.dN[a] = {lagrange_slope(xa, x) * lagrange(ya, y), lagrange(xa, x) * lagrange_slope(ya, y)};
  }
  return s;
}

}  // namespace

CellShape cell_shape(CellKind kind, const Vec2& xi) {
  switch (kind) {
    case CellKind::tri3:
      return triangle_3(xi.x(), xi.y());
    case CellKind::tri6:
      return triangle_6(xi.x(), xi.y());
    case CellKind::quad4:
      return quadrilateral_4(xi.x(), xi.y());
    case CellKind::quad8:
      return quadrilateral_8(xi.x(), xi.y());
    case CellKind::quad9:
      return quadrilateral_9(xi.x(), xi.y());
  }
  throw std::logic_error("cell_shape: unknown cell kind");
}

Points reference_nodes(CellKind kind) {
  Points nodes(node_count(kind), 2);
  if (corner_count(kind) == 3) {
    const double x[] = {0, 1, 0, 0.5, 0.5, 0}, y[] = {0, 0, 1, 0, 0.5, 0.5};
    for (int a = 0; a < node_count(kind); ++a) nodes.row(a) << x[a], y[a];
  } else {
    for (int a = 0; a < node_count(kind); ++a) nodes.row(a) << quad_xi[a], quad_eta[a];
  }
  return nodes;
}

Vec2 reference_centre(CellKind kind) { return corner_count(kind) == 3 ? Vec2(1. / 3, 1. / 3) : Vec2(0, 0); }

void check_cells(const Mesh& mesh) {
  ForEachKind<std::vector<CellShape>> shapes;  // per kind: at the nodes and the centre
  for (const CellKind kind : all_cell_kinds) {
    auto& list = shapes[int(kind)];
    const Points at = reference_nodes(kind);
    for (int a = 0; a < at.rows(); ++a) list.push_back(cell_shape(kind, at.row(a)));
    list.push_back(cell_shape(kind, reference_centre(kind)));
  }
  for (const Cell& cell : mesh.cells) {
    for (const CellShape& s : shapes[int(cell.kind)]) {
      const CellPoint at = cell_point(mesh.nodes, cell, s);
      const double jacobian = at.jacobian();
      // Round-off of the determinant is far below this; a cell flatter than 1e-10 is no cell.
      if (jacobian > 1e-10 * at.x_xi.squaredNorm()) continue;
      throw InputError(worded(mesh.source, ": body '", mesh.bodies[cell.body], "': the element ",
                              near_point(mesh.nodes.row(cell.nodes[0]).transpose()),
                              " is inverted or degenerate (Jacobian ", jacobian,
                              "); expected a positive Jacobian everywhere"));
    }
  }
}

}  // namespace mortise
