// Element sizes of the next mesh.
#include "error/wanted_sizes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "app/solve_scene.hpp"

namespace mortise {
namespace {

// Half of it, with so many edges along its quarter of an arc; the block's are others.
Results pressed_cylinder(int edges) {
  Results r = solve_scene(
      read_scene(MORTISE_SOURCE_DIR "/geo/hertz.toml", {{"mesh.parameters.n_upper", std::to_string(edges)}}));
  estimate(r);
  return r;
}

// Of each edge of the mesh: sizes at its ends differ by no more than the growth over its length.
TEST(WantedSizes, GrowWithinTheLimitOverEachEdge) {
  const Results r = pressed_cylinder(20);
  const Mesh& mesh = r.problem.mesh;
  const VecX sizes =
      wanted_sizes(mesh, r.problem.pairs, *r.estimate, {.line = 100, .far_field = 100, .target = 1e-4, .border = 0})
          .sizes;
  double steepest = 0;
  for (const Cell& cell : mesh.cells)
    for (int a = 0; a < corner_count(cell.kind); ++a) {
      const int i = cell.nodes[a], j = cell.nodes[(a + 1) % corner_count(cell.kind)];
      steepest = std::max(steepest, std::abs(sizes(i) - sizes(j)) / (mesh.nodes.row(i) - mesh.nodes.row(j)).norm());
    }
  EXPECT_LE(steepest, size_growth * (1 + 1e-12));
  EXPECT_GE(steepest, 0.99 * size_growth);  // the limit is used
}

// The half width of Hertz' contact is exact to 0.01 % here.
TEST(WantedSizes, AreLayersWherePFallsToZero) {
  constexpr double half_width = 10.0757e-3;
  std::mt19937 draw(35);
  std::vector<double> off;
  for (int k = 0; k < 8; ++k) {
    Results r = pressed_cylinder(std::uniform_int_distribution(14, 60)(draw));
    PressureEstimate& e = r.estimate->pressures[0];
    ASSERT_EQ(e.local.borders.size(), 1U);
    LineError::Border& border = e.local.borders[0];
    if (!border.place) continue;  // no p* is credible on this mesh
    const Vec2 place = e.line.at(*border.place);
    const double edge = e.line.s(border.edge + 1) - e.line.s(border.edge);
    off.push_back(std::abs(place.x() - half_width) / edge);
    const auto shortest = [&](double line) {
      const ErrorFactors factors{.line = line, .far_field = 1, .target = 1};
      double least = std::numeric_limits<double>::infinity();
      for (const SizeLayers& layer : wanted_sizes(r.problem.mesh, r.problem.pairs, *r.estimate, factors).layers)
        if ((layer.centre - place).norm() < 1e-12) least = std::min(least, layer.least);
      return least / edge;
    };
    EXPECT_NEAR(shortest(64), shortest(16) / 4, 1e-12);  // as the error at a border does
    EXPECT_LT(shortest(64), 1. / 16);
    border.place.reset();
    EXPECT_FALSE(std::isfinite(shortest(64)));
  }
  ASSERT_GE(off.size(), 4U);
  std::ranges::sort(off);
  EXPECT_LT(off[off.size() / 2], 0.1);
}

// Where the place is not known, edges all over that on which contact ends shorten, by 8 at most; where it is, the
// vertices beside it as those that no border makes.
TEST(WantedSizes, AtABorderAreShortAllOverItsEdgeWhereItsPlaceIsUnknown) {
  Results r = pressed_cylinder(20);
  LineError::Border& border = r.estimate->pressures[0].local.borders[0];
  const Edge& edge = r.problem.pairs[0].multiplier.edges[border.edge];
  const auto shortened = [&](double line) {
    const ErrorFactors factors{.line = line, .far_field = 0.25, .target = 1};
    const VecX sizes = wanted_sizes(r.problem.mesh, r.problem.pairs, *r.estimate, factors).sizes;
    return edge_length(r.problem.mesh.nodes, edge) / std::max(sizes(edge.nodes[0]), sizes(edge.nodes[1]));
  };
  ASSERT_TRUE(border.place);
  const double known = shortened(20);
  border.place.reset();
  const double unknown = shortened(20);
  EXPECT_NEAR(unknown, 8, 1);
  EXPECT_LT(known, 0.9 * unknown);
  EXPECT_NEAR(shortened(1e4), unknown, 1e-12);
}

}  // namespace
}  // namespace mortise
