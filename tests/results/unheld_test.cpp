// Displacements of bodies that nothing holds are no answers.
#include "results/unheld.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/accuracy.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// The upper block may slide along x; the lower one is held.
Scene sliding(const TemporaryFolder& folder, const std::string& more) {
  folder.write("s.geo", R"(SetFactory("OpenCASCADE"); Mesh.ElementOrder = 2; Mesh.CharacteristicLengthMax = 0.3;
Rectangle(1) = {0, 0, 0, 3, 1};
Rectangle(2) = {1, 1, 0, 1, 1};
Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("ground") = {1};
Physical Curve("top") = {3};
Physical Curve("foot") = {5};
Physical Curve("head") = {7};
)");
  return read_scene(folder.write("s.toml", R"(mesh.file = "s.geo"
materials.steel = { young = 210e9, poisson = 0.3 }
bodies = { lower = "steel", upper = "steel" }
boundary = [{ on = "ground", displacement = { x = 0, y = 0 } }, { on = "head", pressure = 1e6 }]
contact = [{ between = ["foot", "top"] }]
)" + more));
}

// The body turns about (0, 0) and travels along x; another body's motions are none of its own.
TEST(Unheld, AComponentIsUndeterminedWhereAnyMotionOfTheBodyMovesThePlace) {
  Results r;
  const auto at = [&](double x, double y) { return unheld_at(r, 0, Vec2(x, y)); };
  using Unheld = std::array<bool, 2>;
  r.unheld = {{{.body = 1, .translation = {1, 1}, .rotation = 0, .centre = {0, 0}}}};
  EXPECT_EQ(at(0, 0), (Unheld{false, false}));
  r.unheld = {{{.body = 0, .translation = {1, 0}, .rotation = 1, .centre = {0, 0}}}};
  EXPECT_EQ(at(0, 1), (Unheld{false, false}));  // the turn undoes the travel
  EXPECT_EQ(at(0, -1), (Unheld{true, false}));
  EXPECT_EQ(at(2, 1), (Unheld{false, true}));
  r.unheld.push_back({{.body = 0, .translation = {0, 0}, .rotation = 0, .centre = {0, 0}}});
  EXPECT_EQ(at(0, -1), (Unheld{true, false}));
}

TEST(Unheld, ADisplacementAlongAMotionThatNothingHoldsIsNoGoal) {
  const TemporaryFolder folder;
  const auto told = [&](const std::string& at, const std::string& body) {
    return message_of([&] {
      solve_to_accuracy(sliding(
          folder, "accuracy = { of = \"displacement\", value = 0.05, at = " + at + ", body = \"" + body + "\" }\n"));
    });
  };
  const std::string refused = told("[1.4, 1.6]", "upper");
  expect_contains(refused,
                  "accuracy.at: (1.4, 1.6): the displacement along x is undetermined: nothing holds body 'upper'");
  expect_contains(refused, "expected a support that does");
  EXPECT_EQ(told("[1.4, 0.6]", "lower"), "(nothing was thrown)");
}

TEST(Unheld, AProbeSaysSoAndHasNoBarOfThatComponent) {
  const TemporaryFolder folder;
  const Scene scene = sliding(folder, R"(probe = [{ at = [1.4, 1.6] }, { at = [1.4, 0.6] }]
)");
  Results r = solve_scene(scene);
  estimate(r);
  ASSERT_EQ(r.recovery.probes.size(), 2u);
  EXPECT_TRUE(std::isnan(r.recovery.probes[0].error->u.x()));
  EXPECT_GT(r.recovery.probes[0].error->u.y(), 0);
  EXPECT_GT(r.recovery.probes[1].error->u.x(), 0);
  int said = 0;
  for (const std::string& line : r.warnings)
    said += line.find("probe.0") == 0 && line.find("displacement along x near (1.4, 1.6) is undetermined") != line.npos;
  EXPECT_EQ(said, 1);
  for (const std::string& line : r.warnings) EXPECT_EQ(line.find("probe.1"), line.npos) << line;
}

// A layer on rollers under a round punch that turns: contact is off the punch's middle, and pushes along the normals of
// the side that has the multipliers.
TEST(Unheld, WhatHoldsABodyThatNoLoadDrivesAgainstAForceIsNoted) {
  const TemporaryFolder folder;
  folder.write("a.geo", R"(
Point(1) = {0, 0, 0}; Point(2) = {100, 0, 0}; Point(3) = {100, 20, 0}; Point(4) = {0, 20, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Point(5) = {22, 20.2, 0}; Point(6) = {31, 20, 0}; Point(7) = {40, 20.2, 0}; Point(8) = {40, 40, 0}; Point(9) = {22, 40, 0};
Point(10) = {31, 222.6, 0};
Circle(5) = {5, 10, 6}; Circle(6) = {6, 10, 7}; Line(7) = {7, 8}; Line(8) = {8, 9}; Line(9) = {9, 5};
Curve Loop(2) = {5 : 9}; Plane Surface(2) = {2};
Physical Surface("layer") = {1}; Physical Surface("punch") = {2}; Physical Curve("floor") = {1}; Physical Curve("top") = {3};
Physical Curve("foot") = {5, 6}; Physical Curve("head") = {8}; MeshSize{ : } = 4; MeshSize{5, 6, 7} = 1;
)");
  for (const std::string side : {"foot", "top"}) {
    const Results r = solve_scene(read_scene(folder.write("a.toml", R"toml(
mesh.file = "a.geo"
materials.soft = { young = 20e3, poisson = 0.3 }
bodies = { layer = "soft", punch = "soft" }
boundary = [ { on = "floor", displacement = { y = 0 } },
             { on = "head", rigid = { force = [0, -1200], x = 0, moment = -7000 } } ]
contact = [{ between = ["foot", "top"], multipliers_on = ")toml" + side +
                                                                        "\" }]\n")));
    const Resultant& held = r.recovery.reactions.held_bodies[0];
    EXPECT_EQ(std::ranges::any_of(r.warnings,
                                  [](const std::string& line) {
                                    return line.starts_with("body 'layer': what holds it takes a force of ");
                                  }),
              side == "foot");
    if (side == "top") EXPECT_LE(held.force.norm(), 1e-9 * r.recovery.contacts[0].force.norm());
  }
}

}  // namespace
}  // namespace mortise::test
