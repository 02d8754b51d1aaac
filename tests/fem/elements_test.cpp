#include "fem/elements.hpp"

#include <gtest/gtest.h>

#include "fem/edges.hpp"
#include "fem/quadrature.hpp"

namespace mortise {
namespace {

constexpr CellKind cell_kinds[] = {CellKind::tri3, CellKind::tri6, CellKind::quad4, CellKind::quad8, CellKind::quad9};

TEST(Elements, ShapeFunctionsAreOneAtTheirNodeAndZeroAtTheOthers) {
  for (const CellKind kind : cell_kinds) {
    const Points at = reference_nodes(kind);
    for (Eigen::Index b = 0; b < at.rows(); ++b) {
      const CellShape s = cell_shape(kind, at.row(b));
      for (Eigen::Index a = 0; a < at.rows(); ++a) EXPECT_NEAR(s.N[a], a == b, 1e-14);
    }
  }
}

TEST(Elements, ShapeFunctionsSumToOneAndReproduceCoordinates) {
  for (const CellKind kind : cell_kinds) {
    const Points at = reference_nodes(kind);
    for (const Vec2& xi : product_rule(kind, 4).points) {
      const CellShape s = cell_shape(kind, xi);
      double sum = 0;
      Vec2 position = Vec2::Zero(), slope_sum = Vec2::Zero();
      Eigen::Matrix2d slope = Eigen::Matrix2d::Zero();
      for (Eigen::Index a = 0; a < at.rows(); ++a) {
        sum += s.N[a];
        position += s.N[a] * at.row(a).transpose();
        slope_sum += s.dN[a];
        slope += s.dN[a] * at.row(a);
      }
      EXPECT_NEAR(sum, 1, 1e-14);
      EXPECT_NEAR((position - xi).norm(), 0, 1e-14);
      EXPECT_NEAR(slope_sum.norm(), 0, 1e-13);
      EXPECT_NEAR((slope - Eigen::Matrix2d::Identity()).norm(), 0, 1e-13);
    }
  }
}

TEST(Elements, GradientsAreTheDerivativesOfTheValues) {
  const double h = 1e-6;
  for (const CellKind kind : cell_kinds)
    for (const Vec2& xi : cell_rule(kind).points)
      for (int c = 0; c < 2; ++c) {
        const CellShape s = cell_shape(kind, xi), up = cell_shape(kind, xi + h * Vec2::Unit(c)),
                        down = cell_shape(kind, xi - h * Vec2::Unit(c));
        for (int a = 0; a < node_count(kind); ++a) EXPECT_NEAR(s.dN[a](c), (up.N[a] - down.N[a]) / (2 * h), 1e-8);
      }
}

TEST(Elements, EdgeShapesAreTheTraceOfCellShapes) {
  for (const CellKind kind : cell_kinds) {
    if (corner_count(kind) != 4) continue;
    const int nodes = is_quadratic(kind) ? 3 : 2;
    for (const double xi : {-0.7, 0.1, 0.9}) {
      const CellShape cell = cell_shape(kind, Vec2(xi, -1));  // side 0: corners 0, 1, middle 4
      const EdgeShape edge = edge_shape(nodes, xi);
      EXPECT_NEAR(edge.N[0], cell.N[0], 1e-14);
      EXPECT_NEAR(edge.N[1], cell.N[1], 1e-14);
      if (nodes == 3) {
        EXPECT_NEAR(edge.N[2], cell.N[4], 1e-14);
      }
      EXPECT_NEAR(edge.dN[0], cell.dN[0].x(), 1e-14);
    }
  }
}

TEST(Quadrature, GaussLegendreIsExactToItsDegree) {
  for (int n = 1; n <= 8; ++n) {
    const LineRule rule = gauss_legendre(n);
    for (int power = 0; power <= 2 * n - 1; ++power) {
      double sum = 0;
      for (std::size_t q = 0; q < rule.points.size(); ++q) sum += rule.weights[q] * std::pow(rule.points[q], power);
      EXPECT_NEAR(sum, power % 2 ? 0 : 2.0 / (power + 1), 1e-14) << n << " points, power " << power;
    }
  }
}

TEST(Quadrature, RulesHaveTheAreaOfTheirCell) {
  for (const CellKind kind : cell_kinds)
    for (const CellRule& rule : {cell_rule(kind), stress_points(kind), product_rule(kind, 5)}) {
      double area = 0;
      for (const double w : rule.weights) area += w;
      EXPECT_NEAR(area, corner_count(kind) == 3 ? 0.5 : 4, 1e-13);
    }
}

}  // namespace
}  // namespace mortise
