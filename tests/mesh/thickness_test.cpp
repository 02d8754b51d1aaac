#include "mesh/thickness.hpp"

#include <gtest/gtest.h>

#include "mesh/body_points.hpp"
#include "mesh/grid.hpp"
#include "support/patches.hpp"

namespace mortise {
namespace {

std::vector<Edge> outline_of(const Mesh& mesh, int body) {
  return outlines(boundary_edges(mesh), bonded_to(mesh, body_points(mesh)))[body];
}

std::vector<double> thickness(const Mesh& mesh, const std::string& boundary) {
  const Curve curve = contact_curve(mesh, boundary_index(mesh, boundary));
  return Thickness(mesh.nodes, boundary_edges(mesh), bonded_to(mesh, body_points(mesh))).behind(curve);
}

TEST(Outline, OfAPlateIsItsFourSides) {
  for (const CellKind kind : testing_meshes::all_kinds()) {
    const Mesh mesh = testing_meshes::plate(kind, 5, 3);
    const std::vector<Edge> edges = outline_of(mesh, 0);
    EXPECT_EQ(edges.size(), 16u);
    double twice_area = 0;  // positive: the body lies on the left
    for (const Edge& e : edges)
      twice_area +=
          mesh.nodes(e.nodes[0], 0) * mesh.nodes(e.nodes[1], 1) - mesh.nodes(e.nodes[1], 0) * mesh.nodes(e.nodes[0], 1);
    EXPECT_NEAR(twice_area, 30, 1e-12);
  }
}

TEST(Thickness, OfAPlateIsTheWayToTheOtherSide) {
  for (const CellKind kind : testing_meshes::all_kinds()) {
    const Mesh mesh = testing_meshes::plate(kind, 5, 3);
    for (const double t : thickness(mesh, "top")) EXPECT_NEAR(t, 3, 1e-14);
    for (const double t : thickness(mesh, "left")) EXPECT_NEAR(t, 5, 1e-14);
  }
}

TEST(Thickness, OfALayerIsThatOfTheLayerAndItsGround) {
  Mesh mesh = testing_meshes::plate(CellKind::quad8, 5, 3);
  mesh.bodies = {"ground", "layer"};
  for (int c = 10; c < 15; ++c) mesh.cells[c].body = 1;  // the upper row
  for (const double t : thickness(mesh, "top")) EXPECT_NEAR(t, 3, 1e-14);
}

TEST(Thickness, OfARingIsItsWallFromBothSides) {
  for (const CellKind kind : {CellKind::quad4, CellKind::quad8}) {
    const Mesh mesh = test::mesh_of({test::ring("ring", 48, 2, {3, 1}, 1, 1.25, 360, 0)}, kind);
    for (const char* side : {"ring_south", "ring_north"}) {
      const std::vector<double> list = thickness(mesh, side);
      EXPECT_EQ(list.size(), 48u);
      for (const double t : list) EXPECT_NEAR(t, 0.25, 0.005);
    }
  }
}

}  // namespace
}  // namespace mortise
