#include "mesh/boundary_edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/grid.hpp"
#include "support/messages.hpp"

namespace mortise::test {
namespace {

using testing_meshes::all_kinds;
using testing_meshes::plate;

TEST(BoundaryEdges, AreTheOutlineOfAPlateWithItsNames) {
  for (const CellKind kind : all_kinds()) {
    const Mesh mesh = plate(kind, 3, 2);
    const BoundaryEdges boundary = boundary_edges(mesh);
    EXPECT_EQ(boundary.pieces, 1);
    ASSERT_EQ(boundary.edges.size(), 10U);
    const auto names = names_of(mesh, boundary.edges);
    double area = 0;  // counter-clockwise: positive
    for (std::size_t i = 0; i < boundary.edges.size(); ++i) {
      EXPECT_FALSE(boundary.edges[i].shared);
      EXPECT_EQ(names[i].size(), 2U);  // its side, and "all"
      const Vec2 a = mesh.nodes.row(boundary.edges[i].edge.nodes[0]),
                 b = mesh.nodes.row(boundary.edges[i].edge.nodes[1]);
      area += (a.x() * b.y() - a.y() * b.x()) / 2;
    }
    EXPECT_DOUBLE_EQ(area, 6);
  }
}

TEST(BoundaryEdges, OfBondedBodiesAreShared) {
  Mesh mesh = plate(CellKind::quad8, 2, 1);
  mesh.bodies.push_back("other");
  mesh.cells[1].body = 1;
  const BoundaryEdges boundary = boundary_edges(mesh);
  EXPECT_EQ(boundary.pieces, 2);
  ASSERT_EQ(boundary.edges.size(), 8U);
  EXPECT_EQ(std::count_if(boundary.edges.begin(), boundary.edges.end(), [](const auto& e) { return e.shared; }), 2);
}

TEST(BoundaryEdges, RefuseACellThatIsListedTwice) {
  for (const int body : {0, 1}) {
    Mesh mesh = plate(CellKind::tri6, 2, 2);
    mesh.bodies.push_back("other");
    mesh.cells.push_back(mesh.cells[0]);
    mesh.cells.back().body = body;
    expect_contains(message_of([&] { boundary_edges(mesh); }),
                    "plate.msh: two elements lie on the same side of an edge");
  }
}

}  // namespace
}  // namespace mortise::test
