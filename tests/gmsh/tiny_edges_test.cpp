// Free meshes whose edges are tiny somewhere, by parts of the whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "base/vectors.hpp"
#include "gmsh/free_mesher.hpp"
#include "support/edge_sizes.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// By half of the edges along the first boundary.
void expect_as_asked(const Mesh& mesh, const SizeAt& size, int number) {
  std::vector<double> ratios;
  for (const Edge& edge : mesh.boundaries[0].edges) ratios.push_back(size_ratio(mesh, edge, size));
  std::ranges::sort(ratios);
  EXPECT_GE(ratios[ratios.size() / 2], 0.95) << number << ", " << ratios.size();
}

// Rows of short edges, straight or nearly so: gmsh takes points of them for one another, and smaller sizes help only by
// chance.
TEST(TinyEdges, SizesAreThoseAskedForAlongRowsOfShortEdges) {
  const TemporaryFolder folder;
  FreeMesher mesher(folder.write("a.geo", R"(
Point(1) = {2, 0, 0}; Point(2) = {18, 0, 0}; Point(3) = {20, 2, 0}; Point(4) = {20, 8, 0}; Point(5) = {18, 10, 0};
Point(6) = {2, 10, 0}; Point(7) = {0, 8, 0}; Point(8) = {0, 2, 0};
Point(11) = {18, 2, 0}; Point(12) = {18, 8, 0}; Point(13) = {2, 8, 0}; Point(14) = {2, 2, 0};
Line(1) = {1, 2}; Circle(2) = {2, 11, 3}; Line(3) = {3, 4}; Circle(4) = {4, 12, 5}; Line(5) = {5, 6};
Circle(6) = {6, 13, 7}; Line(7) = {7, 8}; Circle(8) = {8, 14, 1};
Curve Loop(1) = {1:8}; Plane Surface(1) = {1}; Physical Surface("pad") = {1}; Physical Curve("rim") = {1:8};)"),
                    {});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> turn(0, std::numbers::pi / 2), along(-1.9, -1.2), at_tip(-4, -2);
  for (int i = 0; i < 8; ++i) {
    std::vector<std::pair<Vec2, double>> tips;
    const double line = std::pow(10, along(random));
    for (const Vec2& centre : {Vec2(18, 8), Vec2(18, 2), Vec2(2, 8), Vec2(2, 2)}) {
      const double angle = turn(random), x = 2 * std::cos(angle), y = 2 * std::sin(angle);
      tips.emplace_back(centre + Vec2(centre.x() > 10 ? x : -x, centre.y() > 5 ? y : -y), std::pow(10, at_tip(random)));
    }
    const SizeAt size = [&](const Vec2& x) {
      double least = line + 0.5 * std::min(std::abs(x.y()), std::abs(10 - x.y()));
      for (const auto& [tip, h] : tips) least = std::min(least, h + 0.5 * (x - tip).norm());
      return std::min(least, 2.0);
    };
    expect_as_asked(mesher.mesh(size), size, i);
  }
}

// A kink of two curves and a corner, both with edges a ten-millionth of the whole.
TEST(TinyEdges, NoCellIsFlatWhereSizesAreTiny) {
  FreeMesher mesher(MORTISE_SOURCE_DIR "/geo/tent_a.geo", {});
  for (const Vec2& tip : {Vec2(0.4, 0.35), Vec2(0, 0), mesher.curves().front().places.front()})
    for (const double least : {1e-5, 1e-7}) {
      const Mesh mesh = mesher.mesh([&](const Vec2& x) { return std::min(0.1, least + 0.3 * (x - tip).norm()); });
      double flattest = 1;
      for (const Cell& cell : mesh.cells) {
        const Vec2 a = place(mesh, cell.nodes[0]), b = place(mesh, cell.nodes[1]), c = place(mesh, cell.nodes[2]);
        const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        flattest = std::min(flattest, cross(b - a, c - a) / (longest * longest));
      }
      EXPECT_GE(flattest, 1e-3);
    }
}

// Ends of contact on a straight side, with edges down to 5e-8 of the whole: gmsh leaves triangles of three points of
// the side, with any sizes near these.
TEST(TinyEdges, NoCellIsFlatAlongASideWithTinyEdges) {
  const TemporaryFolder folder;
  FreeMesher mesher(folder.write("a.geo", R"(
Point(1) = {-30, 4, 0}; Point(2) = {30, 4, 0}; Point(3) = {30, 14, 0}; Point(4) = {-30, 14, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1}; Physical Surface("pad") = {1}; Physical Curve("side") = {1};)"),
                    {});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> along(-25, 25), tiny(-5.5, -4.5), growth(0.2, 0.6);
  for (int i = 0; i < 10; ++i) {
    std::vector<std::pair<Vec2, double>> ends;
    for (int k = 0; k < 8; ++k) ends.emplace_back(Vec2(along(random), 4), std::pow(10, tiny(random)));
    const double rate = growth(random);
    const SizeAt size = [&](const Vec2& x) {
      double least = 2;
      for (const auto& [end, h] : ends) least = std::min(least, h + rate * (x - end).norm());
      return least;
    };
    expect_as_asked(mesher.mesh(size), size, i);
  }
}

}  // namespace
}  // namespace mortise::test
