// Blocks of which one sticks out past the other's end, by far less than an edge: p has no limit there all the same.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/solve_scene.hpp"
#include "base/printable.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// The upper block's end is `out` beyond the lower one's, which is at x = 1.
Results pressed(const std::string& out, const std::string& contact) {
  const TemporaryFolder folder;
  folder.write("blocks.geo", worded("SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, -0.6, 0, 1, 0.6}; ",
                                    "Rectangle(2) = {0, 0, 0, 1 + ", out, R"(, 0.4};
Physical Surface("lower") = {1}; Physical Surface("upper") = {2}; Physical Curve("ground") = {1};
Physical Curve("top") = {3}; Physical Curve("foot") = {5}; Physical Curve("head") = {7}; Physical Curve("left") = {4, 8};
MeshSize{:} = 0.11; MeshSize{5:8} = 0.08; Mesh.ElementOrder = 2;
)"));
  Results r = solve_scene(read_scene(
      folder.write("blocks.toml",
                   "mesh.file = \"blocks.geo\"\nmaterials.m = { young = 1000, poisson = 0.3 }\nbodies.\"*\" = \"m\"\n"
                   "boundary = [{ on = \"ground\", displacement = { y = 0 } }, { on = \"left\", displacement = { x = "
                   "0 } }, { on = \"head\", pressure = 1 }]\ncontact = [{ between = [\"foot\", \"top\"], " +
                       contact + " }]\n")));
  estimate(r);
  return r;
}

TEST(Overhang, HasNoLimitOfPHoweverSmallItIs) {
  std::mt19937 random(23);
  for (int k = 0; k < 12; ++k) {
    const double size = std::pow(10, std::uniform_real_distribution(-4.7, -1.0)(random)), out = k % 2 ? -size : size;
    const Results r = pressed(worded(out), k / 2 % 2 ? "multipliers_on = \"foot\"" : "multipliers_on = \"top\"");
    const auto& singular = r.estimate->pressures[0].singular;
    ASSERT_EQ(singular.size(), 1u) << out;
    EXPECT_NEAR(singular[0].position.x(), 1 + std::min(out, 0.0), 1e-6) << out;
    EXPECT_NEAR(singular[0].pressure_exponent, 0.774, 1e-3) << out;
    EXPECT_TRUE(r.estimate->pressures[0].excluded[r.estimate->pressures[0].line.nearest(singular[0].position)]) << out;
  }
}

// As drawn, and by what coordinates of a few digits leave.
TEST(Overhang, IsNoneOfRoundOff) {
  for (const char* out : {"0", "1e-12", "-1e-9", "1e-7", "-2e-6"})
    EXPECT_TRUE(pressed(out, "multipliers_on = \"top\"").estimate->pressures[0].singular.empty()) << out;
}

}  // namespace
}  // namespace mortise::test
