#include "mesh/mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "base/errors.hpp"
#include "grid.hpp"
#include "mesh/side_table.hpp"
#include "support/messages.hpp"

namespace mortise {
namespace {

using test::message_of;
using testing_meshes::all_kinds;
using testing_meshes::at;
using testing_meshes::contains;
using testing_meshes::plate;

TEST(Mesh, FindsBodiesAndBoundariesByName) {
  const Mesh mesh = plate(CellKind::quad8, 2, 2);
  EXPECT_EQ(body_index(mesh, "plate"), 0);
  EXPECT_EQ(boundary_index(mesh, "top"), 2);
  EXPECT_EQ(boundary_names(mesh), (std::vector<std::string>{"bottom", "right", "top", "left", "all"}));
}

TEST(Mesh, NamesTheNearestOfAnUnknownName) {
  const Mesh mesh = plate(CellKind::quad8, 2, 2);
  const std::string message = message_of<InputError>([&] { boundary_index(mesh, "botom"); });
  EXPECT_TRUE(contains(message, "plate.msh: unknown boundary 'botom'; did you mean 'bottom'?")) << message;
  EXPECT_THROW(body_index(mesh, "top"), InputError);
}

TEST(Mesh, SidesOfACellRunRoundItCounterClockwise) {
  for (const CellKind kind : all_kinds()) {
    const Mesh mesh = plate(kind, 2, 1);
    for (const Cell& cell : mesh.cells) {
      const int corners = corner_count(kind);
      double twice_area = 0;
      for (int side = 0; side < corners; ++side) {
        const Edge edge = side_edge(cell, side);
        EXPECT_EQ(edge.nodes[1], side_edge(cell, (side + 1) % corners).nodes[0]);
        const Vec2 a = at(mesh, edge.nodes[0]);
        const Vec2 b = at(mesh, edge.nodes[1]);
        twice_area += a.x() * b.y() - a.y() * b.x();
        ASSERT_EQ(edge.node_count, is_quadratic(kind) ? 3 : 2);
        if (edge.node_count == 3) {
          EXPECT_EQ(at(mesh, edge.nodes[2]), Vec2(0.5 * (a + b)));
        }
      }
      EXPECT_EQ(twice_area, corners == 4 ? 2.0 : 1.0);  // exact: a unit square, or half of one
    }
  }
}

TEST(SidesOf, FindsTheSideOfEveryEdgeInBothDirections) {
  for (const CellKind kind : all_kinds()) {
    Mesh mesh = plate(kind, 3, 2);
    Boundary& all = mesh.boundaries[4];
    for (std::size_t i = 0; i < all.edges.size(); i += 2) std::swap(all.edges[i].nodes[0], all.edges[i].nodes[1]);
    const std::vector<CellSide> sides = sides_of(mesh, all);
    ASSERT_EQ(sides.size(), 10U);
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const Edge found = side_edge(mesh.cells[sides[i].cell], sides[i].side);
      const Edge& edge = all.edges[i];
      EXPECT_EQ(std::minmax(found.nodes[0], found.nodes[1]), std::minmax(edge.nodes[0], edge.nodes[1]));
      EXPECT_EQ(found.nodes[2], edge.nodes[2]);
    }
  }
}

TEST(SidesOf, EmptyBoundaryHasNoSides) {
  const Mesh mesh = plate(CellKind::quad4, 1, 1);
  EXPECT_TRUE(sides_of(mesh, {"nothing", {}}).empty());
}

/// What sides_of says about the plate's bottom with one edge changed.
std::string trouble_with(Mesh mesh, const Edge& edge) {
  mesh.boundaries[0].edges[0] = edge;
  return message_of<InputError>([&] { sides_of(mesh, mesh.boundaries[0]); });
}

TEST(SidesOf, SaysWhereAnEdgeIsNotOnTheBoundary) {
  const Mesh mesh = plate(CellKind::quad8, 2, 1);
  const Edge interior = side_edge(mesh.cells[0], 1);
  EXPECT_EQ(trouble_with(mesh, interior),
            "plate.msh: boundary 'bottom': the edge near (1, 0.5) lies between two cells of body 'plate'; expected an "
            "edge of its boundary");

  const Edge across{3, {mesh.cells[0].nodes[0], mesh.cells[0].nodes[2], mesh.cells[0].nodes[4]}};
  EXPECT_TRUE(contains(trouble_with(mesh, across), "'bottom': the edge near (0.5, 0.5) belongs to no cell"));

  Edge bent = mesh.boundaries[0].edges[0];
  bent.nodes[2] = mesh.cells[0].nodes[5];
  EXPECT_TRUE(contains(trouble_with(mesh, bent), "the edge near (0.5, 0) has another middle node than its cell"));

  Edge straight = mesh.boundaries[0].edges[0];
  straight.node_count = 2;
  straight.nodes[2] = -1;
  EXPECT_TRUE(
      contains(trouble_with(mesh, straight), "the edge near (0.5, 0) has 2 nodes, but the side of its cell has 3"));

  EXPECT_TRUE(contains(trouble_with(mesh, mesh.boundaries[0].edges[1]), "the edge near (1.5, 0) is listed twice"));
}

TEST(SidesOf, SaysWhereAnEdgeBelongsToTwoBodies) {
  Mesh mesh = plate(CellKind::tri6, 2, 1);
  mesh.bodies = {"left part", "right part"};
  mesh.cells[2].body = mesh.cells[3].body = 1;
  const std::string message = trouble_with(mesh, side_edge(mesh.cells[0], 1));
  EXPECT_TRUE(contains(message, "the edge near (1, 0.5) belongs to both bodies 'left part' and 'right part'"))
      << message;
}

}  // namespace
}  // namespace mortise
