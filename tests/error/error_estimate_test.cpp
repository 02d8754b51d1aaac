// The estimated error of the stresses: what is said of a coarse mesh, and what of a good one.
#include "error/error_estimate.hpp"

#include <gtest/gtest.h>

#include "app/solve_scene.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// A block pressed by an arm that bends, 1 long and 0.2 thick, its far end moved down; n elements along the arm.
std::string arm(int n, int order, bool triangles) {
  return "n = " + std::to_string(n) + "; Mesh.ElementOrder = " + std::to_string(order) + R"(;
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 0.2};
Rectangle(2) = {0.7, -0.2, 0, 0.2, 0.2};
Transfinite Curve{1, 3} = n + 1;
Transfinite Curve{2, 4} = n / 5 + 1;
Transfinite Curve{5 : 8} = n + 1;
Transfinite Surface{1, 2};
Physical Surface("arm") = {1};
Physical Surface("block") = {2};
Physical Curve("foot") = {1};
Physical Curve("end") = {2};
Physical Curve("wall") = {4};
Physical Curve("ground") = {5};
Physical Curve("top") = {7};
)" + (triangles ? "" : "Recombine Surface{1, 2};\n");
}

Results solved(const std::string& geo) {
  const TemporaryFolder folder;
  folder.write("a.geo", geo);
  Results r = solve_scene(read_scene(folder.write("a.toml", R"(
mesh.file = "a.geo"
materials.steel = { young = 210e9, poisson = 0.3 }
bodies = { arm = "steel", block = "steel" }
boundary = [
  { on = "wall", displacement = { x = 0, y = 0 } }, { on = "end", displacement = { y = -1e-4 } },
  { on = "ground", displacement = { x = 0, y = 0 } },
]
contact = [{ between = ["foot", "top"] }]
)")));
  estimate(r);
  return r;
}

int coarse(const Results& r) {
  int count = 0;
  for (const std::string& line : r.warnings) count += line.find("the mesh is coarse: stresses are off by") == 0;
  return count;
}

TEST(EnergyEstimate, NamesAnArmOfLinearElementsThatIsTooStiff) {
  const Results fine = solved(arm(40, 2, false));
  const double force = std::abs(fine.recovery.contacts[0].force.y());
  for (const bool triangles : {true, false}) {
    const Results r = solved(arm(5, 1, triangles));
    EXPECT_GT(std::abs(r.recovery.contacts[0].force.y()), 1.2 * force);
    ASSERT_EQ(coarse(r), 1);
    EXPECT_EQ(r.problem.mesh.bodies[r.estimate->energy.body], "arm");
    EXPECT_GT(r.estimate->energy.part, 0.5);
  }
  EXPECT_EQ(coarse(fine), 0);
  EXPECT_LT(fine.estimate->energy.error, 0.1);
}

TEST(EnergyEstimate, FallsWithTheMesh) {
  double before = 1;
  for (const int n : {5, 10, 20, 40}) {
    const double error = solved(arm(n, 2, true)).estimate->energy.error;
    EXPECT_LT(error, 0.75 * before) << n;
    before = error;
  }
}

TEST(EnergyEstimate, IsZeroWithoutStress) {
  Results r = solved(arm(5, 2, true));
  r.solution.u.setZero();
  estimate(r);
  EXPECT_EQ(r.estimate->energy.error, 0);
}

// A shift leaves round-off of stresses, which the elements and the patches see as it comes.
TEST(EnergyEstimate, IsZeroWhereStressesAreRoundOff) {
  Results r = solved(arm(5, 2, true));
  for (Eigen::Index i = 0; i < r.solution.u.size(); ++i) r.solution.u(i) = 0.1 + 1e-17 * double(i % 7);
  r.warnings.clear();
  estimate(r);
  EXPECT_EQ(r.estimate->energy.error, 0);
  EXPECT_EQ(coarse(r), 0);
  for (Eigen::Index i = 0; i < r.solution.u.size(); ++i) r.solution.u(i) += 1e-10 * double(i % 7);
  estimate(r);
  EXPECT_GT(r.estimate->energy.error, 0.1);
}

TEST(EnergyEstimate, IsNotANumberWhereADisplacementIsNot) {
  Results r = solved(arm(5, 2, true));
  r.solution.u(7) = std::numeric_limits<double>::quiet_NaN();
  estimate(r);
  EXPECT_FALSE(r.estimate->energy.error >= 0);
}

}  // namespace
}  // namespace mortise::test
