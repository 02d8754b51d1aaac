#include "mesh/body_points.hpp"

#include <gtest/gtest.h>

#include "mesh/grid.hpp"

namespace mortise {
namespace {

TEST(BondedTo, BodiesThatShareNodesHangTogether) {
  Mesh mesh = testing_meshes::plate(CellKind::quad8, 5, 3);
  mesh.bodies = {"lower", "middle", "upper"};
  for (int c = 0; c < 15; ++c) mesh.cells[c].body = c / 5;
  EXPECT_EQ(bonded_to(mesh, body_points(mesh)), (std::vector<int>{0, 0, 0}));
}

TEST(BondedTo, BodiesWithNodesOfTheirOwnDoNot) {
  Mesh mesh = testing_meshes::plate(CellKind::tri3, 2, 2);
  const Mesh other = mesh;
  const int nodes = int(mesh.nodes.rows());
  mesh.bodies = {"one", "other"};
  mesh.nodes.conservativeResize(2 * nodes, 2);
  mesh.nodes.bottomRows(nodes) = other.nodes;
  for (Cell cell : other.cells) {
    cell.body = 1;
    for (int a = 0; a < node_count(cell.kind); ++a) cell.nodes[a] += nodes;
    mesh.cells.push_back(cell);
  }
  EXPECT_EQ(bonded_to(mesh, body_points(mesh)), (std::vector<int>{0, 1}));
}

}  // namespace
}  // namespace mortise
