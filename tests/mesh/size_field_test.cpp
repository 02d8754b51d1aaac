// Sizes over a mesh, from which the next one is made.
#include "mesh/size_field.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "support/two_plates.hpp"

namespace mortise {
namespace {

TEST(SizeField, IsLinearOverTheMeshAndThatOfTheNearestTriangleOutside) {
  for (const CellKind kind : all_cell_kinds) {
    test::TwoPlates plates;
    plates.kind_upper = plates.kind_lower = kind;
    const Mesh mesh = test::mesh_of(plates);
    const auto size = [](const Vec2& x) { return 1 + 2 * x.x() + 3 * x.y(); };
    VecX sizes(mesh.nodes.rows());
    for (Eigen::Index i = 0; i < sizes.size(); ++i) sizes(i) = size(mesh.nodes.row(i).transpose());
    const SizeField field(mesh, sizes, {});
    for (const Vec2& x : {Vec2(0.123, 0.456), Vec2(0.7, 0.3), Vec2(0, 0), Vec2(0.8, 0.6)})
      EXPECT_NEAR(field(x), size(x), 1e-12);
    EXPECT_NEAR(field(Vec2(0.81, 0.3)), size(Vec2(0.8, 0.3)), 0.05);
    EXPECT_NEAR(field(Vec2(40, 0.6)), size(Vec2(0.8, 0.6)), 1);
  }
}

TEST(SizeField, TakesTheLeastWhereBodiesMeetAndUnderLayers) {
  const Mesh mesh = test::mesh_of({});
  VecX sizes = VecX::Ones(mesh.nodes.rows());
  for (const Cell& cell : mesh.cells)
    if (cell.body == 1)
      for (int a = 0; a < node_count(cell.kind); ++a) sizes(cell.nodes[a]) = 0.5;
  const SizeField field(mesh, sizes, {{Vec2(0.8, 0.6), 1e-3, 2}});
  EXPECT_EQ(field(Vec2(0.31, 0.3)), 0.5);
  EXPECT_NEAR(field(Vec2(0.8, 0.6)), 1e-3, 1e-15);
  EXPECT_NEAR(field(Vec2(0.8, 0.5)), 1e-3 + 0.2, 1e-12);
}

// A disc of which each edge stands for an arc, in a block that is as coarse as the disc is large: drawn interference.
TEST(SizeField, IsThatOfABodyOnItsCurvesInsideAnotherBody) {
  constexpr int edges = 12;
  Mesh mesh;
  mesh.nodes.resize(edges + 5, 2);
  const auto on_disc = [](double k) {
    return Vec2(std::cos(k * std::numbers::pi / 6), std::sin(k * std::numbers::pi / 6));
  };
  for (int k = 0; k < edges; ++k) mesh.nodes.row(k) = on_disc(k).transpose();
  mesh.nodes.bottomRows(5) << 0, 0, -4, -9, 4, -9, 4, -0.9, -4, -0.9;
  for (int k = 0; k < edges; ++k) mesh.cells.push_back({CellKind::tri3, 0, {k, (k + 1) % edges, edges}});
  for (const int k : {2, 3}) mesh.cells.push_back({CellKind::tri3, 1, {edges + 1, edges + k, edges + k + 1}});
  VecX sizes = VecX::Constant(edges + 5, 3);
  sizes.head(edges + 1).setConstant(0.01);
  const SizeField field(mesh, sizes, {});
  for (int k = 0; k < 10 * edges; ++k) EXPECT_NEAR(field(on_disc(0.1 * k)), 0.01, 1e-12) << k;
  EXPECT_NEAR(field(Vec2(0, -1.5)), 3, 1e-12);
}

TEST(SizeField, GrowsNoFasterThanItMay) {
  const Mesh mesh = test::mesh_of({});
  VecX sizes = VecX::Constant(mesh.nodes.rows(), 10);
  const int small = mesh.cells[0].nodes[0];
  sizes(small) = 0.01;
  limit_growth(mesh, 0.3, sizes);
  EXPECT_EQ(sizes(small), 0.01);
  int limited = 0;
  for (const Cell& cell : mesh.cells)
    for (int a = 0; a < corner_count(cell.kind); ++a) {
      const int i = cell.nodes[a], j = cell.nodes[(a + 1) % corner_count(cell.kind)];
      const double length = (mesh.nodes.row(i) - mesh.nodes.row(j)).norm();
      EXPECT_LE(std::abs(sizes(i) - sizes(j)), 0.3 * length + 1e-12);
      limited += sizes(i) < 10;
    }
  EXPECT_GT(limited, 10);
  EXPECT_EQ(sizes(mesh.cells.back().nodes[0]), 10);  // the other body
}

}  // namespace
}  // namespace mortise
