#include "fem/cell_cuts.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

#include "fem/elements.hpp"
#include "support/two_plates.hpp"

namespace mortise::test {
namespace {

// int f over two plates that fill [0, 0.8] x [0, 0.6].
double integral(const std::string& text, CellKind kind, int* cut = nullptr) {
  TwoPlates plates;
  plates.kind_upper = plates.kind_lower = kind;
  const Mesh mesh = mesh_of(plates);
  const Field field(text, {.key = "body_force.0"});
  double sum = 0;
  for (const Cell& cell : mesh.cells) {
    const auto pieces = resolving_pieces(mesh.nodes, cell, {{&field, FieldRange(field), 1}});
    if (cut) *cut += pieces.empty() ? 0 : 1;
    const CellRule rule = piece_rule(pieces.empty() ? std::vector{whole_cell(cell.kind)} : pieces);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const CellShape shape = cell_shape(cell.kind, rule.points[q]);
      Vec2 x = Vec2::Zero();
      Eigen::Matrix2d J = Eigen::Matrix2d::Zero();
      for (int a = 0; a < node_count(cell.kind); ++a) {
        x += shape.N[a] * mesh.nodes.row(cell.nodes[a]).transpose();
        J += shape.dN[a] * mesh.nodes.row(cell.nodes[a]);
      }
      sum += rule.weights[q] * (J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0)) * field(x);
    }
  }
  return sum;
}

constexpr CellKind kinds[] = {CellKind::tri3, CellKind::tri6, CellKind::quad4, CellKind::quad8, CellKind::quad9};

TEST(CellCuts, AreNoneOfWhatIsLinear) {
  for (const CellKind kind : kinds) {
    int cut = 0;
    EXPECT_NEAR(integral("1 + x - 2 * y", kind, &cut), 0.48 * (1 + 0.4 - 0.6), 1e-12);
    EXPECT_EQ(cut, 0);
  }
}

TEST(CellCuts, MakeIntegralsOfSpotsAndJumpsExact) {
  for (const CellKind kind : kinds) {
    for (const double w : {2e-2, 1e-3}) {
      const std::string square = std::to_string(w * w);
      EXPECT_NEAR(integral("exp(-((x - 0.31)^2 + (y - 0.17)^2) / (" + square + "))", kind) / (std::numbers::pi * w * w),
                  1, 0.02)
          << w;
    }
    EXPECT_NEAR(integral("x < 0.437 ? 1 : 0", kind), 0.437 * 0.6, 1e-4);
    EXPECT_NEAR(integral("x + y < 0.5 ? 1 : 0", kind), 0.125, 1e-4);
  }
}

TEST(CellMisfit, IsWhatAPolynomialLeaves) {
  TwoPlates plates;
  plates.kind_upper = plates.kind_lower = CellKind::quad8;
  const Mesh mesh = mesh_of(plates);
  const Cell& cell = mesh.cells[0];
  const double x0 = mesh.nodes(cell.nodes[0], 0), x1 = mesh.nodes(cell.nodes[1], 0);
  std::ostringstream step;
  step.precision(17);
  step << "x < " << (x0 + x1) / 2 << " ? 0 : 1";
  const Field field(step.str(), {.key = "body_force.0"});
  const auto pieces = resolving_pieces(mesh.nodes, cell, {{&field, FieldRange(field), 1}});
  for (const int degree : {1, 2})  // of a step less 1/2 + 3/4 xi, without xi^2: int (1/2 - 3/4 t)^2 dt = 1/16
    EXPECT_NEAR(misfit(mesh.nodes, cell, pieces, degree, [&](const Vec2& x) { return VecX::Constant(1, field(x)); })
                    .root_mean_square,
                0.25, 2e-3);
  const auto parabola = [&](const Vec2& x) {
    return VecX::Constant(1, std::pow((2 * x.x() - x0 - x1) / (x1 - x0), 2));
  };
  EXPECT_NEAR(misfit(mesh.nodes, cell, pieces, 1, parabola).root_mean_square, std::sqrt(4. / 45), 1e-12);
  EXPECT_NEAR(misfit(mesh.nodes, cell, pieces, 2, parabola).root_mean_square, 0, 1e-12);
}

}  // namespace
}  // namespace mortise::test
