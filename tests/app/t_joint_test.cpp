// Two like blocks side by side on a third, one pressed down more than the other: beside the place where all three meet
// the foot of the lesser opens, by less than coarse meshes show.
#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "app/accuracy.hpp"
#include "support/drawn_foot.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

Scene t_joint(const TemporaryFolder& folder, std::mt19937& random) {
  folder.write("t.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 60, 20}; Rectangle(2) = {0, 20, 0, 30, 15}; Rectangle(3) = {30, 20, 0, 30, 15};
Physical Surface("base") = {1}; Physical Surface("left") = {2}; Physical Surface("right") = {3};
Physical Curve("ground") = {1}; Physical Curve("base_top") = {3};
Physical Curve("left_foot") = {5}; Physical Curve("left_face") = {6}; Physical Curve("left_head") = {7};
Physical Curve("left_end") = {8};
Physical Curve("right_foot") = {9}; Physical Curve("right_end") = {10}; Physical Curve("right_head") = {11};
Physical Curve("right_face") = {12};
)");
  const double lesser = draw(random, 4, 6), ratio = draw(random, 1.3, 1.9);
  std::ostringstream toml;
  toml << R"(mesh.file = "t.geo"
model.plane = "strain"
materials.m = { young = 1e5, poisson = 0.3 }
bodies = { "*" = "m" }
boundary = [
  { on = "ground", displacement = { x = 0, y = 0 } }, { on = "left_end", displacement = { x = 0 } },
  { on = "right_end", pressure = )"
       << draw(random, 1, 2) << " }, { on = \"left_head\", pressure = " << lesser
       << " }, { on = \"right_head\", pressure = " << ratio * lesser << R"( },
]
contact = [
  { between = ["left_foot", "base_top"] }, { between = ["right_foot", "base_top"] },
  { between = ["left_face", "right_face"] },
]
)";
  return read_scene(folder.write("t.toml", toml.str()));
}

TEST(TJoint, IsOneWherePHasNoLimitAndWhereAFootEnds) {
  std::mt19937 random(4);
  for (int k = 0; k < 4; ++k) {
    const TemporaryFolder folder;
    Scene scene = t_joint(folder, random);
    scene.accuracy = AccuracySpec{.value = 0.05};
    const Results coarse = *solve_to_accuracy(scene);
    scene.accuracy->value = 0.002;
    const Results fine = *solve_to_accuracy(scene);
    const auto joint = [](const Results& r) { return r.estimate->pressures[2].singular; };
    ASSERT_EQ(joint(coarse).size(), 1u) << k;
    EXPECT_NEAR(joint(coarse)[0].pressure_exponent, 0.726586, 1e-5) << k;
    EXPECT_NEAR(joint(fine)[0].pressure_exponent, 0.726586, 1e-5) << k;
    const ContactResults &foot = coarse.recovery.contacts[0], &exact = fine.recovery.contacts[0];
    EXPECT_LT(exact.length_in_contact, 30 - 1e-5) << k;  // it opens
    EXPECT_LE(std::abs(foot.length_in_contact - exact.length_in_contact), *foot.length_error + *exact.length_error)
        << k;
    EXPECT_LE(*foot.length_error, 1) << k;
  }
}

}  // namespace
}  // namespace mortise::test
