#include "mesh/slenderness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../mesh/grid.hpp"

namespace mortise {
namespace {

using testing_meshes::plate;

struct Strip {
  double length, thickness;
  Mesh mesh;
};

// A straight strip of so many cells along and across, finer towards one end, as a physical surface of its own.
Strip strip(std::mt19937& random) {
  std::uniform_real_distribution<double> part(0, 1);
  std::uniform_int_distribution<int> cells(1, 20), kind(0, int(all_cell_kinds.size()) - 1);
  const int nx = cells(random), ny = 1 + cells(random) / 5;
  Strip drawn{.length = std::exp(3 * part(random)), .thickness = std::exp(part(random) - 0.5), .mesh = {}};
  drawn.mesh = plate(all_cell_kinds[kind(random)], nx, ny);
  std::ranges::shuffle(drawn.mesh.cells, random);  // the first may lie anywhere
  const double grading = 1 + 2 * part(random);
  for (auto node : drawn.mesh.nodes.rowwise())
    node = Eigen::RowVector2d(drawn.length * std::pow(node.x() / nx, grading), drawn.thickness * node.y() / ny);
  return drawn;
}

TEST(Slenderness, IsThatOfAStripHoweverItIsMeshed) {
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    const auto [length, thickness, mesh] = strip(random);
    const double area = length * thickness, least = (length * length + thickness * thickness) / area,
                 most = std::pow(length + thickness, 2) / area;  // along and across
    for (const double found : slenderness(mesh)) {
      EXPECT_GE(found, least * (1 - 1e-12)) << i;
      EXPECT_LE(found, most * (1 + 1e-12)) << i;
    }
  }
}

// Bent by an angle, the shortest way is along the inside, and to it from either end; closed, half of all round.
TEST(Slenderness, GoesWithinABentStrip) {
  for (const double angle : {0.5, 3.0, 6.2, 2 * M_PI}) {
    Mesh mesh = plate(CellKind::quad8, 200, 2);
    constexpr double inside = 10, outside = 11;
    for (auto node : mesh.nodes.rowwise()) {
      const double turned = angle * node.x() / 200, radius = inside + (outside - inside) * node.y() / 2;
      node = Eigen::RowVector2d(radius * std::cos(turned), radius * std::sin(turned));
    }
    if (angle == 2 * M_PI) {  // the nodes of the last section are those of the first
      std::vector<int> same(mesh.nodes.rows());
      for (int a = 0; a < int(same.size()); ++a) {
        same[a] = a;
        for (int b = 0; b < a && same[a] == a; ++b)
          if ((mesh.nodes.row(a) - mesh.nodes.row(b)).norm() < 1e-9) same[a] = b;
      }
      for (Cell& cell : mesh.cells)
        for (int a = 0; a < node_count(cell.kind); ++a) cell.nodes[a] = same[cell.nodes[a]];
    }
    const double way = inside * (angle == 2 * M_PI ? M_PI : angle), area = angle / 2 * (121 - 100);
    const double found = slenderness(mesh).at(mesh.cells[0].nodes[0]);
    EXPECT_GE(found, 0.99 * way * way / area) << angle;
    EXPECT_LE(found, 1.01 * std::pow(way + 2 * (outside - inside), 2) / area) << angle;
  }
}

TEST(Slenderness, IsOfEachPieceOfABody) {
  std::mt19937 random(7);
  const Strip one = strip(random), other = strip(random);
  Mesh both = one.mesh;
  const int first = int(one.mesh.nodes.rows());
  both.nodes.conservativeResize(first + other.mesh.nodes.rows(), 2);
  both.nodes.bottomRows(other.mesh.nodes.rows()) = other.mesh.nodes;
  for (Cell cell : other.mesh.cells) {
    for (int a = 0; a < node_count(cell.kind); ++a) cell.nodes[a] += first;
    both.cells.push_back(cell);
  }
  const std::vector<double> found = slenderness(both);
  EXPECT_EQ(found.front(), slenderness(one.mesh).front());
  EXPECT_EQ(found.back(), slenderness(other.mesh).front());
  EXPECT_NE(found.front(), found.back());
}

}  // namespace
}  // namespace mortise
