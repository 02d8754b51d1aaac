#include "problem/body_fields.hpp"

#include <gtest/gtest.h>

#include "fem/elements.hpp"
#include "support/two_plates.hpp"

namespace mortise::test {
namespace {

constexpr CellKind kinds[] = {CellKind::tri3, CellKind::tri6, CellKind::quad4, CellKind::quad8, CellKind::quad9};

// int N_a f over a cell, by a rule.
VecX moments(const Mesh& mesh, const Cell& cell, const Field& f, const CellRule& rule) {
  VecX sum = VecX::Zero(node_count(cell.kind));
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const CellShape shape = cell_shape(cell.kind, rule.points[q]);
    const CellPoint point = cell_point(mesh.nodes, cell, shape);
    for (int a = 0; a < sum.size(); ++a) sum(a) += rule.weights[q] * point.jacobian() * shape.N[a] * f(point.x);
  }
  return sum;
}

// Smooth fields too: a point in the middle of a linear triangle would miss a hundredth of what varies.
TEST(BodyFields, AreIntegratedWithTheShapeFunctionsOfEveryKind) {
  for (const CellKind kind : kinds)
    for (const char* text : {"x - 0.3 * y", "sin(1.5 * x + 0.2) * cos(1.5 * y)", "exp(-20 * x) * y"}) {
      TwoPlates plates;
      plates.kind_upper = plates.kind_lower = kind;
      const Mesh mesh = mesh_of(plates);
      const Field f(text, {.key = "body_force.0"});
      BodyFields fields(mesh);
      for (int b = 0; b < int(mesh.bodies.size()); ++b) fields.add(b, f);
      fields.find_scales();
      for (const Cell& cell : mesh.cells) {
        const VecX exact = moments(mesh, cell, f, product_rule(kind, 14));
        const double area = moments(mesh, cell, Field(1), product_rule(kind, 4)).cwiseAbs().sum();
        EXPECT_LT((moments(mesh, cell, f, fields.rule(cell)) - exact).cwiseAbs().maxCoeff(), 1e-6 * area) << text;
      }
    }
}

TEST(BodyFields, LeaveCellsOfOtherBodiesTheirOwnRule) {
  const Mesh mesh = mesh_of(TwoPlates{});
  const Field varies("x", {.key = "body_force.0"}), constant(2);
  BodyFields fields(mesh);
  fields.add(0, varies);
  fields.add(1, constant);
  fields.find_scales();
  for (const Cell& cell : mesh.cells) EXPECT_EQ(fields.rule(cell).points.empty(), cell.body == 1);
}

}  // namespace
}  // namespace mortise::test
