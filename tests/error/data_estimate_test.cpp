// What functions that the mesh does not follow do to the bars of p.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <sstream>

#include "app/accuracy.hpp"
#include "app/solve_scene.hpp"
#include "support/pressure_at.hpp"
#include "support/two_blocks.hpp"

namespace mortise::test {
namespace {

// Two blocks 2 wide. `load`: of the scene besides the pressure on top.
Results loaded_blocks(int lower, int upper, const std::string& load) {
  const auto edges = [](int count) { return std::to_string(count + 1); };
  return pressed_blocks(
      "Mesh.ElementOrder = 2; Rectangle(1) = {0, 0, 0, 2, 1}; Rectangle(2) = {0, 1, 0, 2, 0.6};\n"
      "Transfinite Curve{1, 3} = " +
          edges(lower) + "; Transfinite Curve{2, 4} = " + edges(lower / 2) +
          "; Transfinite Curve{5, 7} = " + edges(upper) + "; Transfinite Curve{6, 8} = " + edges(3 * upper / 10) + ";",
      "multipliers_on = \"lower_contact\"", load);
}

// The upper one strained in a square 0.1 wide that stands on the line; its edges are vertices of meshes of 80 edges.
Results strained_blocks(int lower, int upper) {
  return loaded_blocks(lower, upper, R"([[initial_strain]]
body = "upper"
strain = { yy = "abs(x - 1) < 0.05 && y < 1.1 ? 1e-3 : 0", xx = 0, zz = 0, xy = 0 }
)");
}

TEST(DataEstimate, AStrainWithinACellOnTheLineIsInTheBarsBesideIt) {
  const Results fine = strained_blocks(60, 80);
  for (const int edges : {5, 7, 9, 13}) {
    const Results coarse = strained_blocks(edges, 2 * edges);
    for (const ContactNode& node : coarse.recovery.contacts[0].multiplier.nodes) {
      const double off = std::abs(node.p - pressure_at(fine.recovery.contacts[0].multiplier.nodes, node.position.x()));
      EXPECT_LE(off, node.p_error) << edges << " edges, x = " << node.position.x();
    }
  }
}

// Recovered stresses follow it, and the estimate of cells has what it does.
TEST(DataEstimate, AStrainThatIsAParabolaInAQuadraticCellIsNoMisfit) {
  const Results r = loaded_blocks(4, 4, R"([[initial_strain]]
body = "upper"
strain = { yy = "1e-3 * x^2", xx = 0, zz = 0, xy = 0 }
)");
  ASSERT_FALSE(r.problem.misfits.parts.empty());
  for (const DataMisfit& part : r.problem.misfits.parts) EXPECT_LT(part.size, 1e-9);  // 1e-3 of a linear function
}

// In the upper block a force of 0.05 in a square 0.04 wide, 0.05 above the line: of the bars' windows the narrowest is
// six times as wide as that. Cells are 0.08 to 0.17 wide, and those of the reference 0.0125.
TEST(DataEstimate, AForceWithinACellBesideTheLineIsInTheBarsBeneathIt) {
  const std::string force =
      R"(body_force = [{ body = "upper", force = ["0", "abs(x - 1) < 0.02 && abs(y - 1.05) < 0.02 ? -31.25 : 0"] }])";
  const Results fine = loaded_blocks(120, 160, force);
  for (const int edges : {6, 8, 10, 12}) {
    const Results coarse = loaded_blocks(edges, 2 * edges, force);
    for (const ContactNode& node : coarse.recovery.contacts[0].multiplier.nodes) {
      const double off = std::abs(node.p - pressure_at(fine.recovery.contacts[0].multiplier.nodes, node.position.x()));
      EXPECT_LE(off, node.p_error) << edges << " edges, x = " << node.position.x();
    }
  }
}

// Springs under a block on a place narrower than the edges there bear most of a load, and their dent in it, of which
// the mesh shows nothing, is a part of how far all else sinks.
TEST(DataEstimate, StiffSpringsWithinAnEdgeAreInTheBars) {
  const TemporaryFolder folder;
  std::mt19937 random(11);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  int nodes = 0, inside = 0;
  for (int k = 0; k < 8; ++k) {
    std::ostringstream geo, scene;
    const int edges = std::uniform_int_distribution(8, 20)(random);
    geo << "Mesh.ElementOrder = 2;\n"
        << outlines({{{0, 0}, {1, 0}, {1, 0.36}, {0, 0.36}, {0, 0.36}, {1, 0.36}, {1, 0.74}, {0, 0.74}}}, 0)
        << "Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1}; Curve Loop(2) = {5 : 8}; Plane Surface(2) = {2};\n"
        << unlike_blocks << "Transfinite Curve{1, 3} = " << edges + 1 << "; Transfinite Curve{2, 4} = " << edges / 3 + 1
        << "; Transfinite Curve{5, 7} = " << edges + 4 << "; Transfinite Curve{6, 8} = " << edges / 3 + 2 << ";\n";
    folder.write("blocks.geo", geo.str());
    scene << R"(mesh.file = "blocks.geo"
materials.m = { young = 1000, poisson = 0.3 }
bodies = { lower = "m", upper = "m" }
contact = [{ between = ["upper_contact", "lower_contact"] }]
boundary = [{ on = ["lower_left", "lower_right", "upper_left", "upper_right"], displacement = { x = 0 } },
  { on = "top", pressure = 1 }, { on = "bottom", foundation = "1000 * (1 + (abs(x - )"
          << between(0.2, 0.8) << ") < " << between(0.003, 0.01) << " ? " << between(20, 60) << " : 0))\" }]\n";
    const std::string path = folder.write("scene.toml", scene.str());
    Results coarse = solve_scene(read_scene(path));
    estimate(coarse);
    const auto fine = solve_to_accuracy(read_scene(path, {{"accuracy.value", "0.1%"}}));
    ASSERT_TRUE(fine->accuracy->reached());
    for (const ContactNode& node : coarse.recovery.contacts[0].multiplier.nodes) {
      ++nodes;
      inside += std::abs(node.p - pressure_at(fine->recovery.contacts[0].multiplier.nodes, node.position.x())) <=
                node.p_error;
    }
  }
  EXPECT_GE(inside, 0.95 * nodes) << nodes;
}

// Two rings that are their own copies under quarter turns, on foundations that are alike in all directions; the outer
// one is strained in a square 0.1 wide on the line, so many quarter turns from (1, 0).
std::vector<ContactNode> nodes_of_rings_strained_at(int quarter) {
  const TemporaryFolder folder;
  folder.write("rings.geo", R"(Mesh.ElementOrder = 2; Point(1) = {0, 0, 0}; n[] = {9, 9, 13, 13};
Macro Ring
  p = newp; l = newl;
  For k In {0 : 3}
    Point(p + k) = {a * Cos(k * Pi / 2), a * Sin(k * Pi / 2), 0};
    Point(p + 4 + k) = {b * Cos(k * Pi / 2), b * Sin(k * Pi / 2), 0};
  EndFor
  For k In {0 : 3}
    Circle(l + k) = {p + k, 1, p + (k + 1) % 4}; Circle(l + 4 + k) = {p + 4 + k, 1, p + 4 + (k + 1) % 4};
    Line(l + 8 + k) = {p + k, p + 4 + k};
  EndFor
  s = news;
  For k In {0 : 3}
    Curve Loop(s + k) = {l + k, l + 8 + (k + 1) % 4, -(l + 4 + k), -(l + 8 + k)}; Plane Surface(s + k) = {s + k};
  EndFor
  Transfinite Curve{l : l + 7} = count; Transfinite Curve{l + 8 : l + 11} = 5; Transfinite Surface{s : s + 3};
  Recombine Surface{s : s + 3};
Return
a = 0.5; b = 1; count = 9; Call Ring;
Physical Surface("inner") = {s : s + 3}; Physical Curve("bore") = {l : l + 3};
Physical Curve("inner_contact") = {l + 4 : l + 7};
a = 1; b = 2; count = 13; Call Ring;
Physical Surface("outer") = {s : s + 3}; Physical Curve("outer_contact") = {l : l + 3};
Physical Curve("rim") = {l + 4 : l + 7};)");
  const std::string along[] = {"x", "y", "-x", "-y"}, across[] = {"y", "x", "y", "x"};
  Results r = solve_scene(read_scene(folder.write("scene.toml", R"(mesh.file = "rings.geo"
materials.m = { young = 1000, poisson = 0.3 }
bodies = { inner = "m", outer = "m" }
boundary = [{ on = ["bore", "rim"], foundation = [10, 10] }, { on = "rim", pressure = 1 }]
contact = [{ between = ["inner_contact", "outer_contact"], multipliers_on = "inner_contact" }]
[[initial_strain]]
body = "outer"
strain = { xx = "abs()" + across[quarter] + ") < 0.05 && " + along[quarter] +
                                                                    R"( > 0 && )" + along[quarter] +
                                                                    R"( < 1.1 ? 1e-3 : 0", yy = 0, zz = 0, xy = 0 }
)")));
  estimate(r);
  return r.recovery.contacts[0].multiplier.nodes;
}

// Wherever the closed curve begins.
TEST(DataEstimate, AStrainOnARingIsNotInTheBarsOfItsOtherSide) {
  for (const int quarter : {0, 1, 2, 3}) {
    const Vec2 strained(std::array{1, 0, -1, 0}[quarter], std::array{0, 1, 0, -1}[quarter]);
    double largest_bar = 0, largest_far = 0;
    for (const ContactNode& node : nodes_of_rings_strained_at(quarter)) {
      largest_bar = std::max(largest_bar, node.p_error);
      if (node.position.dot(strained) < -0.5) largest_far = std::max(largest_far, node.p_error);
    }
    EXPECT_GT(largest_far, 0) << quarter;
    EXPECT_LT(largest_far, 0.1 * largest_bar) << quarter;  // 0.99 where a cell at the seam raises all
  }
}

}  // namespace
}  // namespace mortise::test
