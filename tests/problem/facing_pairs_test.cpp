// Contact pairs that find themselves: the wall of bricks, and what a pattern may be mistaken for.
#include "problem/facing_pairs.hpp"

#include <gtest/gtest.h>

#include <set>

#include "app/solve_scene.hpp"
#include "support/audited_scenes.hpp"
#include "support/differences.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

Scene wall(std::vector<Override> more = {}) { return read_scene(MORTISE_SOURCE_DIR "/geo/wall.toml", more); }

// Two squares upon a long one, 0.01 above it; `contact`: the entries.
Scene squares(const TemporaryFolder& folder, const std::string& contact) {
  folder.write("a.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 4, 1}; Rectangle(2) = {0, 1.01, 0, 1, 1}; Rectangle(3) = {2.5, 1.01, 0, 1, 1};
Transfinite Curve{1 : 12} = 5; Transfinite Surface{1 : 3}; Recombine Surface{1 : 3};
Physical Surface("base") = {1}; Physical Surface("left") = {2}; Physical Surface("right") = {3};
Physical Curve("ground") = {1}; Physical Curve("base_top") = {3};
Physical Curve("left_foot") = {5}; Physical Curve("left_side") = {8}; Physical Curve("left_head") = {7};
Physical Curve("right_foot") = {9}; Physical Curve("right_side") = {12}; Physical Curve("right_head") = {11};
)");
  return read_scene(folder.write("a.toml", R"(
mesh.file = "a.geo"
materials = { steel = { young = 210e9, poisson = 0.3 }, soft = { young = 1e9, poisson = 0.3 } }
bodies = { "*" = "steel", left = "soft" }
boundary = [
  { on = "ground", displacement = { x = 0, y = 0 } }, { on = "*_side", displacement = { x = 0 } },
  { on = "*_head", displacement = { y = -0.02 } },
]
)" + contact));
}

std::set<std::string> pairs_of(const Problem& checked) {
  std::set<std::string> names;
  for (const ContactPair& pair : checked.pairs) names.insert(pair.spec.between[0] + " " + pair.spec.between[1]);
  return names;
}

TEST(FacingPairs, OfAWallAreAllNeighboursAndNoCorners) {
  const Problem checked = check_scene(wall({{"mesh.parameters.bricks", "3"}, {"mesh.parameters.courses", "4"}}));
  // In a course one pair less than bricks (3, 4, 3, 4), between two courses 2 x 3.
  EXPECT_EQ(checked.pairs.size(), 2u + 3 + 2 + 3 + 3 * 6);
  EXPECT_EQ(pairs_of(checked).size(), checked.pairs.size());
  for (const ContactPair& pair : checked.pairs) EXPECT_NEAR(pair.coupling.covered_length, 1, 1e-9);
}

TEST(FacingPairs, GiveTheWallItsWeight) {
  for (const Solver solver : {Solver::direct, Solver::feti}) {
    Scene scene = wall();
    scene.method.solver = solver;
    const Results r = solve_scene(scene);
    EXPECT_EQ(r.status, Status::solved);
    double weight = 0;  // of the topmost course and the load on it
    for (const ContactPair& pair : r.problem.pairs)
      if (pair.spec.between[0].starts_with("brick_4_") && pair.spec.between[1].starts_with("brick_5_"))
        weight += std::abs(r.recovery.contacts[&pair - r.problem.pairs.data()].force.y());
    EXPECT_NEAR(weight, 8e6 + 8 * 20e3, 1e-6 * 8e6);
  }
}

TEST(FacingPairs, AreThoseWithinADistance) {
  const TemporaryFolder folder;
  const std::string pattern = R"(contact = [{ between = ["base_*", "*_foot"])";
  EXPECT_EQ(pairs_of(check_scene(squares(folder, pattern + " }]"))),
            (std::set<std::string>{"base_top left_foot", "base_top right_foot"}));
  expect_contains(message_of([&] { check_scene(squares(folder, pattern + ", within = 0.001 }]")); }),
                  "between: no curves 'base_*' and '*_foot' of two bodies face each other within contact.within");
  EXPECT_EQ(check_scene(squares(folder, R"(contact = [{ between = ["*", "*"], within = 0.02 }])")).pairs.size(), 2u);
}

// By a degree at most, over a mesh that is fine at the foot: along its normals the base is as near as edges are long.
TEST(FacingPairs, AreNoneOfASideThatLeansOverBesideItsFoot) {
  for (const double lean : {0.001, 0.009, 0.017}) {
    const TemporaryFolder folder;
    folder.write("a.geo", "lean = " + std::to_string(lean) + R"(;
Point(1) = {0, 0, 0}; Point(2) = {4, 0, 0}; Point(3) = {4, 1, 0}; Point(4) = {0, 1, 0};
Point(5) = {1, 1, 0}; Point(6) = {2, 1, 0}; Point(7) = {2 + lean, 2, 0}; Point(8) = {1 - lean, 2, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1}; Curve Loop(5) = {5 : 8}; Plane Surface(5) = {5};
Transfinite Curve{1 : 5, 7} = 11; Transfinite Curve{6} = 21 Using Progression 1.7; Transfinite Curve{-8} = 21 Using Progression 1.7;
Transfinite Surface{1, 5}; Recombine Surface{1, 5};
Physical Surface("base") = {1}; Physical Surface("block") = {5};
Physical Curve("ground") = {1}; Physical Curve("base_top") = {3};
Physical Curve("block_foot") = {5}; Physical Curve("block_right") = {6}; Physical Curve("block_left") = {8};
)");
    const Problem checked = check_scene(read_scene(folder.write("a.toml", R"(
mesh.file = "a.geo"
materials.steel = { young = 210e9, poisson = 0.3 }
bodies = { "*" = "steel" }
boundary = [{ on = "ground", displacement = { x = 0, y = 0 } }]
contact = [{ between = ["*", "*"] }]
)")));
    EXPECT_EQ(pairs_of(checked), std::set<std::string>{"base_top block_foot"}) << lean;
  }
}

TEST(FacingPairs, AreMeasuredBetweenTheCurvesAndNotBetweenTheBoxesAroundThem) {
  const TemporaryFolder folder;
  folder.write("a.geo", R"(
Point(1) = {0, 0, 0}; Point(2) = {4, 0, 0}; Point(3) = {4, 3, 0}; Point(4) = {0, 1, 0};
Point(5) = {0, 1.1, 0}; Point(6) = {4, 3.1, 0}; Point(7) = {4, 5, 0}; Point(8) = {0, 5, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Curve Loop(1) = {1 : 4}; Curve Loop(2) = {5 : 8}; Plane Surface(1) = {1}; Plane Surface(2) = {2};
Physical Surface("low") = {1}; Physical Surface("up") = {2};
Physical Curve("low_top") = {3}; Physical Curve("up_foot") = {5}; Physical Curve("ground") = {1, 7};
)");
  const auto pairs_within = [&](const char* within) {
    return check_scene(read_scene(folder.write("a.toml", R"(
mesh.file = "a.geo"
materials.m = { young = 1, poisson = 0.3 }
bodies = { "*" = "m" }
boundary = [{ on = "ground", displacement = { x = 0, y = 0 } }]
contact = [{ between = ["low_*", "up_*"], within = )" + std::string(within) +
                                                             " }]\n")))
        .pairs.size();
  };
  EXPECT_EQ(pairs_within("0.095"), 1u);  // 0.1 above one another, 0.0894 apart
  EXPECT_THROW(pairs_within("0.085"), InputError);
}

// However far they may be apart, no curve faces another through its own body; what is found can be coupled.
TEST(FacingPairs, AreNotThroughABody) {
  const Problem checked = check_scene(wall({{"contact.within", "1e9"}, {"contact.initial_gap", "curve"}}));
  EXPECT_GT(checked.pairs.size(), 100u);
  for (const std::string& names : pairs_of(checked)) {
    EXPECT_FALSE(names == "brick_0_1_left brick_0_2_right") << names;
    EXPECT_TRUE(names.find("_left ") == std::string::npos || !names.ends_with("_left")) << names;
  }
  expect_contains(message_of([&] {
                    check_scene(wall({{"contact.within", "1e9"}}));
                  }),
                  "initial_gap = \"closed\", but 'brick_");
}

// Further apart than half an edge, whatever the mesh: a pair that the heads' way closes is found by another solve, one
// that stays open is none. The same by the solver of cases, forth and back.
TEST(FacingPairs, AreThoseThatBodiesWouldGoThrough) {
  const TemporaryFolder folder;
  const auto scene_of = [&](double gap, double way) {
    folder.write("a.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 4, 1}; Rectangle(2) = {0, 1, 0, 1, 1}; Rectangle(3) = {2.5, )" +
                              std::to_string(1 + gap) +
                              R"(, 0, 1, 1};
Transfinite Curve{1 : 12} = 9; Transfinite Surface{1 : 3}; Recombine Surface{1 : 3};
Physical Surface("base") = {1}; Physical Surface("left") = {2}; Physical Surface("right") = {3};
Physical Curve("ground") = {1}; Physical Curve("base_top") = {3};
Physical Curve("left_foot") = {5}; Physical Curve("left_head") = {7};
Physical Curve("right_foot") = {9}; Physical Curve("right_head") = {11};
)");
    return read_scene(folder.write("a.toml", R"(
mesh.file = "a.geo"
materials = { steel = { young = 210e9, poisson = 0.3 } }
bodies = { "*" = "steel" }
boundary = [
  { on = "ground", displacement = { x = 0, y = 0 } },
  { on = "*_head", displacement = { x = 0, y = )" +
                                                 std::to_string(-way) + R"( } },
]
contact = [{ between = ["base_*", "*_foot"] }]
)"));
  };
  const auto force_on_right = [](const Results& r) {
    for (const ContactPair& pair : r.problem.pairs)
      if (pair.spec.between[1] == "right_foot")
        return std::abs(r.recovery.contacts[&pair - &r.problem.pairs[0]].force.y());
    return 0.;
  };
  for (const double gap : {0.07, 0.1, 0.15}) {
    CaseSolver cases;
    for (const double part : {0.5, 0.9, 1.1, 1.5}) {
      const Scene scene = scene_of(gap, part * gap);
      const Results alone = solve_scene(scene);
      EXPECT_EQ(alone.problem.pairs.size(), part > 1 ? 2u : 1u) << gap << " " << part;
      EXPECT_EQ(joined(alone.warnings).find("pass through"), std::string::npos) << joined(alone.warnings);
      EXPECT_NEAR(force_on_right(cases.solve(scene)), force_on_right(alone), 1e-9 * force_on_right(alone));
      Scene named = scene;
      named.contacts[0].between = {"base_top", "left_foot"};
      named.contacts.push_back(named.contacts[0]);
      named.contacts[1].between[1] = "right_foot";
      EXPECT_NEAR(force_on_right(solve_scene(named)), force_on_right(alone), 1e-6 * force_on_right(alone));
      EXPECT_EQ(force_on_right(alone) > 0, part > 1);
      EXPECT_GT(alone.seconds.factorise, 0);
    }
  }
}

// A whole that falls into pieces has these at its place in the list, whose numbers come after all others'.
TEST(FacingPairs, OfPatternsAreByNumber) {
  const TemporaryFolder folder;
  folder.write("a.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 4, 1}; Rectangle(2) = {0, 1, 0, 1, 1}; Rectangle(3) = {2.5, 1, 0, 1, 1};
Mesh.MeshSizeMax = 0.3; Physical Surface("base") = {1}; Physical Surface("left") = {2}; Physical Surface("right") = {3};
Physical Curve("a_base") = {1, 3}; Physical Curve("b_base") = {2};
Physical Curve("left_foot") = {5}; Physical Curve("right_foot") = {9}; Physical Curve("heads") = {7, 11};
)");
  const Problem p = check_scene(read_scene(folder.write("a.toml", R"(
mesh.file = "a.geo"
materials = { steel = { young = 210e9, poisson = 0.3 } }
bodies = { "*" = "steel" }
boundary = [{ on = "b_base", displacement = { x = 0, y = 0 } }, { on = "heads", displacement = { x = 0, y = 0 } }]
contact = [{ between = ["*_base", "*_foot"] }]
)")));
  ASSERT_EQ(p.patterns.size(), 1u);
  EXPECT_EQ(p.patterns[0][0].size(), 3u);
  for (const std::vector<int>& side : p.patterns[0]) EXPECT_TRUE(std::ranges::is_sorted(side));
}

// Sheets that lie on one another have no pairs through a sheet, however thin it is.
TEST(FacingPairs, OfClosedCurvesAreOneCurve) {
  const TemporaryFolder folder;
  for (const double thickness : {0.3, 0.1, 0.02})
    for (const std::string how : {"initial_gap = \"closed\"", "condition = \"tied\""}) {
      std::string geo = "SetFactory(\"OpenCASCADE\"); Mesh.MeshSizeMin = 1; Mesh.MeshSizeMax = 1;\n";
      for (int k = 1; k <= 4; ++k) {
        const std::string n = std::to_string(k);
        geo += "Rectangle(" + n + ") = {0, " + std::to_string(k * thickness) + ", 0, 6, " + std::to_string(thickness) +
               "}; Transfinite Curve{" + std::to_string(4 * k - 3) + "," + std::to_string(4 * k - 1) +
               "} = " + std::to_string(5 + k) + "; Physical Surface(\"s_" + n + "\") = {" + n +
               "}; Physical Curve(\"s_" + n + "_foot\") = {" + std::to_string(4 * k - 3) + "}; Physical Curve(\"s_" +
               n + "_top\") = {" + std::to_string(4 * k - 1) + "};\n";
      }
      folder.write("a.geo", geo);
      const Problem checked = check_scene(read_scene(folder.write("a.toml", R"(
mesh.file = "a.geo"
materials = { steel = { young = 210e9, poisson = 0.3 } }
bodies = { "*" = "steel" }
boundary = [{ on = "s_1_foot", displacement = { x = 0, y = 0 } }, { on = "s_4_top", displacement = { x = 0 } }]
contact = [{ between = ["s_*", "s_*"], )" + how + " }]\n")));
      EXPECT_EQ(checked.pairs.size() + checked.mesh.ties.size(), 3u) << thickness << " " << how;
    }
}

TEST(FacingPairs, LeaveWhatIsNamedItsOwnSettings) {
  const TemporaryFolder folder;
  const Problem checked = check_scene(squares(folder, R"(
[[contact]]
between = ["*", "*"]
[[contact]]
between = ["base_top", "left_foot"]
condition = "bilateral"
)"));
  ASSERT_EQ(checked.pairs.size(), 2u);
  for (const ContactPair& pair : checked.pairs)
    EXPECT_EQ(pair.spec.condition, pair.spec.between[1] == "left_foot" ? Condition::bilateral : Condition::unilateral);
}

TEST(FacingPairs, ACurveInTwoPairsIsSolvedByEverySolver) {
  const TemporaryFolder folder;
  Scene scene = squares(folder, R"(contact = [{ between = ["*", "*"] }])");
  const Results direct = solve_scene(scene);
  scene.method.solver = Solver::feti;
  const Results feti = solve_scene(scene);
  ASSERT_EQ(direct.recovery.contacts.size(), 2u);
  for (const Results* r : {&direct, &feti}) {
    EXPECT_EQ(r->status, Status::solved);
    const double left = std::abs(r->recovery.contacts[0].force.y()),
                 right = std::abs(r->recovery.contacts[1].force.y());
    EXPECT_GT(left / right, 1.0 / 210);  // the base gives way under the stiff one
    EXPECT_LT(left / right, 2.0 / 210);
  }
  EXPECT_LE(pressure_difference(feti, direct), 1e-8);
}

TEST(FacingPairs, ABodyOfTwoMaterialsIsRefused) {
  const TemporaryFolder folder;
  Scene scene = squares(folder, R"(contact = [{ between = ["*", "*"] }])");
  scene.bodies = {{"l*", "steel"}, {"*", "soft"}};
  expect_contains(message_of([&] { check_scene(scene); }),
                  "body 'left' is a 'l*' of 'steel' and a '*' of 'soft'; expected one material");
}

}  // namespace
}  // namespace mortise::test
