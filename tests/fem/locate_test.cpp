// Places in cells of every kind, and beside them.
#include "fem/locate.hpp"

#include <gtest/gtest.h>

#include "support/two_plates.hpp"

namespace mortise {
namespace {

Vec2 position(const Mesh& mesh, const CellPlace& place) {
  const Cell& cell = mesh.cells[place.cell];
  const CellShape shape = cell_shape(cell.kind, place.xi);
  Vec2 x = Vec2::Zero();
  for (int a = 0; a < node_count(cell.kind); ++a) x += shape.N[a] * mesh.nodes.row(cell.nodes[a]).transpose();
  return x;
}

TEST(Locate, FindsPlacesInAllKindsOfCells) {
  for (const CellKind kind : all_cell_kinds) {
    test::TwoPlates plates;
    plates.height = [](double x) { return 0.3 + 0.1 * x - 0.2 * x * x; };
    plates.kind_upper = plates.kind_lower = kind;
    const Mesh mesh = test::mesh_of(plates);
    for (int e = 0; e < int(mesh.cells.size()); ++e) {
      const Vec2 x = position(mesh, {e, reference_centre(mesh.cells[e].kind), 0});
      const auto place = locate(mesh, mesh.cells[e].body, x);
      ASSERT_TRUE(place) << e;
      EXPECT_EQ(place->cell, e);
      EXPECT_LE((position(mesh, *place) - x).norm(), 1e-14);
      EXPECT_LE(place->distance, 1e-14);
    }
  }
}

TEST(Locate, GoesToTheNearestPlaceBesideABodyAndToNoneAway) {
  const Mesh mesh = test::mesh_of({});
  const int upper = body_index(mesh, "upper"), lower = body_index(mesh, "lower");
  const auto beside = locate(mesh, lower, {0.41, -0.01});
  ASSERT_TRUE(beside);
  EXPECT_NEAR(beside->distance, 0.01, 1e-12);
  EXPECT_LE((position(mesh, *beside) - Vec2(0.41, 0)).norm(), 1e-12);
  EXPECT_FALSE(locate(mesh, lower, {0.41, -0.05}));
  EXPECT_FALSE(locate(mesh, upper, {0.41, 0.1}));
  EXPECT_TRUE(locate(mesh, upper, {0.41, 0.3}) && locate(mesh, lower, {0.41, 0.3}));  // where they meet
}

// Beyond each side and each corner of a triangle.
TEST(Locate, GoesToTheNearestPlaceOfATriangle) {
  Mesh mesh;
  mesh.bodies = {"one"};
  mesh.nodes = (Points(3, 2) << 0, 0, 1, 0, 0, 1).finished();
  mesh.cells = {{CellKind::tri3, 0, {0, 1, 2}}};
  const std::pair<Vec2, Vec2> places[] = {{{0.73, 0.31}, {0.71, 0.29}},
                                          {{0.3, -0.04}, {0.3, 0}},
                                          {{-0.03, 0.6}, {0, 0.6}},
                                          {{1.05, 0.01}, {1, 0}},
                                          {{-0.02, 1.05}, {0, 1}}};
  for (const auto& [x, nearest] : places) {
    const auto place = locate(mesh, 0, x);
    ASSERT_TRUE(place) << x.transpose();
    EXPECT_LE((position(mesh, *place) - nearest).norm(), 1e-14) << x.transpose();
    EXPECT_NEAR(place->distance, (x - nearest).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace mortise
