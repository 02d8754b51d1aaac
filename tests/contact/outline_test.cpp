#include "contact/outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/grid.hpp"

namespace mortise::test {
namespace {

TEST(Outline, KnowsTheSignedDistanceOfEveryPoint) {
  for (const CellKind kind : testing_meshes::all_kinds()) {
    const Mesh mesh = testing_meshes::plate(kind, 3, 2);  // [0, 3] x [0, 2]
    const Outline o = outline(boundary_edges(mesh), mesh.nodes);
    ASSERT_EQ(o.pieces.size(), 1U);
    EXPECT_DOUBLE_EQ(o.pieces[0].area, 6);
    EXPECT_DOUBLE_EQ(o.pieces[0].perimeter, 10);
    for (double x = -1.05; x < 4; x += 0.3)
      for (double y = -1.05; y < 3; y += 0.3) {
        const Vec2 out(std::max({-x, x - 3, 0.}), std::max({-y, y - 2, 0.}));
        const double inside = std::min({x, 3 - x, y, 2 - y});
        EXPECT_NEAR(nearest(o, 0, {x, y}).distance, inside > 0 ? -inside : out.norm(), 1e-12) << x << " " << y;
      }
  }
}

// Boxes of slanted edges hold places far from these: the nearest box is not always the nearest edge's.
TEST(Outline, FindsTheNearestOfSlantedEdges) {
  for (const double angle : {0.3, 0.8, 2.0}) {
    Mesh mesh = testing_meshes::plate(CellKind::quad8, 3, 2);
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
    for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) mesh.nodes.row(i) = turn * Vec2(mesh.nodes.row(i).transpose());
    const Outline o = outline(boundary_edges(mesh), mesh.nodes);
    for (double x = -1.05; x < 4; x += 0.3)
      for (double y = -1.05; y < 3; y += 0.3) {
        const Vec2 out(std::max({-x, x - 3, 0.}), std::max({-y, y - 2, 0.}));
        const double inside = std::min({x, 3 - x, y, 2 - y});
        EXPECT_NEAR(nearest(o, 0, turn * Vec2(x, y)).distance, inside > 0 ? -inside : out.norm(), 1e-12)
            << angle << " " << x << " " << y;
      }
  }
}

// By ends and middles: a square of 8-node cells whose one outer middle node lies 0.2 outside.
TEST(Outline, KnowsTheAreaBehindCurvedEdges) {
  Mesh mesh = testing_meshes::plate(CellKind::quad8, 1, 1);
  for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i)
    if (mesh.nodes(i, 0) == 1 && mesh.nodes(i, 1) == 0.5) mesh.nodes(i, 0) = 1.2;
  const Outline o = outline(boundary_edges(mesh), mesh.nodes);
  ASSERT_EQ(o.pieces.size(), 1U);
  EXPECT_NEAR(o.pieces[0].area, 1 + 0.2 / 2, 1e-15);
}

}  // namespace
}  // namespace mortise::test
