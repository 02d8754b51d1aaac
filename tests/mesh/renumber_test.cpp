#include "mesh/renumber.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "base/errors.hpp"
#include "grid.hpp"
#include "mesh/side_table.hpp"
#include "support/messages.hpp"

namespace mortise {
namespace {

using test::message_of;
using testing_meshes::plate;

/// Corner coordinates of all cells: the same mesh, however numbered, has the same.
std::vector<std::vector<double>> shape(const Mesh& mesh) {
  std::vector<std::vector<double>> cells;
  for (const Cell& cell : mesh.cells) {
    std::vector<double> row{static_cast<double>(cell.body)};
    for (int i = 0; i < node_count(cell.kind); ++i) {
      row.push_back(mesh.nodes(cell.nodes[i], 0));
      row.push_back(mesh.nodes(cell.nodes[i], 1));
    }
    cells.push_back(row);
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// Of the cells' spans of node numbers, the middle one.
int median_span(const Mesh& mesh) {
  std::vector<int> spans;
  for (const Cell& cell : mesh.cells) {
    const auto end = cell.nodes.begin() + node_count(cell.kind);
    const auto [low, high] = std::minmax_element(cell.nodes.begin(), end);
    spans.push_back(*high - *low);
  }
  std::nth_element(spans.begin(), spans.begin() + spans.size() / 2, spans.end());
  return spans[spans.size() / 2];
}

TEST(Renumber, KeepsTheMeshAndDropsLooseNodes) {
  Mesh mesh = plate(CellKind::quad9, 7, 5);
  const auto before = shape(mesh);
  const Eigen::Index nodes = mesh.nodes.rows();
  mesh.nodes.conservativeResize(nodes + 3, 2);
  mesh.nodes.bottomRows(3).setConstant(100.0);
  renumber(mesh);
  EXPECT_EQ(mesh.nodes.rows(), nodes);
  EXPECT_EQ(shape(mesh), before);
  EXPECT_NO_THROW(sides_of(mesh, mesh.boundaries[4]));
}

TEST(Renumber, SortsCellsByBody) {
  Mesh mesh = plate(CellKind::tri3, 4, 4);
  mesh.bodies = {"a", "b"};
  for (std::size_t c = 0; c < mesh.cells.size(); c += 2) mesh.cells[c].body = 1;
  renumber(mesh);
  EXPECT_TRUE(std::is_sorted(mesh.cells.begin(), mesh.cells.end(),
                             [](const Cell& a, const Cell& b) { return a.body < b.body; }));
}

TEST(Renumber, KeepsNeighboursCloseHoweverTheyWereNumbered) {
  Mesh mesh = plate(CellKind::quad8, 40, 40);
  std::mt19937 random(1);
  std::shuffle(mesh.cells.begin(), mesh.cells.end(), random);
  renumber(mesh);
  const Mesh first = mesh;
  std::shuffle(mesh.cells.begin(), mesh.cells.end(), random);
  renumber(mesh);
  EXPECT_EQ(mesh.nodes, first.nodes);  // the order does not depend on the file's
  // Row by row, each cell of 40 in a row would span some 120 numbers; at random, 4000 of the 4961.
  EXPECT_LT(median_span(mesh), 60);
}

TEST(Renumber, SaysWhereAnEdgeHasANodeOfNoCell) {
  Mesh mesh = plate(CellKind::quad4, 2, 1);
  mesh.nodes.conservativeResize(mesh.nodes.rows() + 1, 2);
  mesh.nodes.bottomRows(1) << 0.4, 0.3;
  mesh.boundaries[0].edges[0].nodes[1] = static_cast<int>(mesh.nodes.rows()) - 1;
  EXPECT_EQ(message_of<InputError>([&] { renumber(mesh); }),
            "plate.msh: boundary 'bottom': the edge near (0.4, 0.3) belongs to no body");
}

}  // namespace
}  // namespace mortise
