// Accuracies of the pressure on geometries that are hard to mesh.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <sstream>
#include <tuple>

#include "app/accuracy.hpp"
#include "support/scene_to_accuracy.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// A disc that comes into a block by less than its gap at the points of the first meshes: their p is zero, not the
// answer.
TEST(Accuracy, OfContactThatIsShorterThanTheFirstEdgesIsFound) {
  const test::TemporaryFolder folder;
  folder.write("disc.geo", R"(
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 0.5, 0}; Point(4) = {0, 0.5, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Point(11) = {0.51, 1, 0}; Point(12) = {0.01, 1, 0}; Point(13) = {0.51, 0.5, 0}; Point(14) = {1.01, 1, 0};
Circle(11) = {12, 11, 13}; Circle(12) = {13, 11, 14}; Line(13) = {14, 12};
Curve Loop(2) = {11:13}; Plane Surface(2) = {2};
Physical Surface("block") = {1}; Physical Surface("disc") = {2};
Physical Curve("ground") = {1}; Physical Curve("face") = {3}; Physical Curve("round") = {11, 12}; Physical Curve("head") = {13};)");
  const std::string file = folder.write("disc.toml", R"(
mesh = { file = "disc.geo" }
materials.steel = { young = 200e3, poisson = 0.3 }
bodies = { block = "steel", disc = "steel" }
boundary = [{ on = ["ground"], displacement = { x = 0, y = 0 } },
            { on = ["head"], displacement = { x = 0, y = -5e-6 } }]
contact = [{ between = ["round", "face"] }]
accuracy = { value = "5%", first_edges = 6 })");
  std::map<std::string, double> forces;
  for (const char* of : {"pressure", "peak", "half_width", "force"}) {
    const auto r = solve_to_accuracy(read_scene(file, {{"accuracy.of", of}}));
    ASSERT_TRUE(r);
    EXPECT_TRUE(r->accuracy->reached()) << of << ": " << r->accuracy->reason;
    forces[of] = r->recovery.contacts[0].force.y();
  }
  for (const auto& [of, force] : forces) {
    EXPECT_LT(force, 0) << of;
    EXPECT_NEAR(force, forces["force"], 0.05 * std::abs(force)) << of;
  }
}

// Hertz' contact may be 1e-5 of the radius.
TEST(Accuracy, OfHertzIsReachedHoweverLightTheLoad) {
  std::mt19937 random(6);
  for (int k = 0; k < 6; ++k) {
    const double part = std::pow(10, std::uniform_real_distribution<double>(-k - 1, -k)(random));
    std::ostringstream pressure;
    pressure << 4.6e6 * part;
    const auto r = solve_to_accuracy(scene_to_accuracy("hertz", "0.2%", {{"boundary.2.pressure", pressure.str()}}));
    EXPECT_TRUE(r->accuracy->reached()) << part << ": " << r->accuracy->reason;
    EXPECT_LE(r->accuracy->solves.size(), 5u) << part;
    EXPECT_NEAR(r->recovery.contacts[0].p_max, 581.29e6 * std::sqrt(part), 0.002 * 581.29e6 * std::sqrt(part)) << part;
  }
}

// A pad presses on a beam, which so comes down on a stop: other contact is there, and the stop's is shorter than its
// edges.
TEST(Accuracy, OfShortContactBesideAnotherPairIsFound) {
  const test::TemporaryFolder folder;
  folder.write("beam.geo", R"(
Point(1) = {0, 0, 0}; Point(2) = {60, 0, 0}; Point(3) = {60, 6, 0}; Point(4) = {0, 6, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Point(11) = {26, 6, 0}; Point(12) = {34, 6, 0}; Point(13) = {34, 9, 0}; Point(14) = {26, 9, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(2) = {11:14}; Plane Surface(2) = {2};
Point(21) = {55, -10, 0}; Point(22) = {45, -10, 0}; Point(23) = {55, 0, 0}; Point(24) = {65, -10, 0};
Circle(21) = {22, 21, 23}; Circle(22) = {23, 21, 24}; Line(23) = {24, 22};
Curve Loop(3) = {21:23}; Plane Surface(3) = {3};
Physical Surface("beam") = {1}; Physical Surface("pad") = {2}; Physical Surface("stop") = {3};
Physical Curve("root") = {4}; Physical Curve("under") = {1}; Physical Curve("over") = {3}; Physical Curve("foot") = {11};
Physical Curve("head") = {13}; Physical Curve("round") = {21, 22}; Physical Curve("base") = {23};)");
  const std::string file = folder.write("beam.toml", R"(
mesh.file = "beam.geo"
materials.steel = { young = 210e3, poisson = 0.3 }
bodies = { "*" = "steel" }
boundary = [{ on = ["root", "base"], displacement = { x = 0, y = 0 } }, { on = "head", rigid = { x = 0, force = [0, -0.3] } }]
contact = [{ between = ["foot", "over"] }, { between = ["round", "under"] }]
accuracy = { value = "2%" })");
  std::map<std::string, double> forces;
  for (const std::string of : {"pressure", "half_width", "force"}) {
    const auto r = solve_to_accuracy(read_scene(
        file,
        {{"accuracy.of", of}, {of == "force" ? "accuracy.pair" : "accuracy.exclude", of == "force" ? "1" : "0.1"}}));
    ASSERT_TRUE(r);
    EXPECT_TRUE(r->accuracy->reached()) << of << ": " << r->accuracy->reason;
    forces[of] = r->recovery.contacts[1].force.norm();
  }
  for (const auto& [of, force] : forces) EXPECT_NEAR(force, forces["force"], 0.04 * forces["force"]) << of;
}

// A crowned block on a flat one: an arc whose places are differences of its radius.
std::string crowned_block(double radius) {
  std::ostringstream out;
  out.precision(17);
  const double rise = radius - std::sqrt(radius * radius - 100);
  out << "Point(1) = {-10, " << rise << ", 0}; Point(2) = {0, " << radius << ", 0}; Point(3) = {10, " << rise << ", 0};"
      << R"(
Circle(1) = {1, 2, 3};
Point(4) = {10, 12, 0}; Point(5) = {-10, 12, 0}; Line(2) = {3, 4}; Line(3) = {4, 5}; Line(4) = {5, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1}; Physical Surface("up") = {1};
Physical Curve("foot") = {1}; Physical Curve("head") = {3};
Point(6) = {-15, -15, 0}; Point(7) = {15, -15, 0}; Point(8) = {15, 0, 0}; Point(9) = {-15, 0, 0};
Line(5) = {6, 7}; Line(6) = {7, 8}; Line(7) = {8, 9}; Line(8) = {9, 6};
Curve Loop(2) = {5:8}; Plane Surface(2) = {2}; Physical Surface("low") = {2};
Physical Curve("bottom") = {5}; Physical Curve("top") = {7};
Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1; MeshSize{:} = 1;
)";
  return out.str();
}

// No point of the arc is singular, and the meshes are those of any other arc.
TEST(Accuracy, OfCrownsIsReachedHoweverFlatTheyAre) {
  for (const auto& [radius, force, edges] :
       {std::tuple{1e5, "60", "14"}, {1e5, "60", "16"}, {5e4, "60", "20"}, {2e4, "5", "20"}}) {
    const TemporaryFolder folder;
    folder.write("a.geo", crowned_block(radius));
    const Scene scene = read_scene(folder.write("a.toml", std::string(R"([mesh]
file = "a.geo"
[model]
plane = "strain"
[materials]
steel = { young = 210e3, poisson = 0.3 }
aluminium = { young = 70e3, poisson = 0.33 }
[bodies]
up = "steel"
low = "aluminium"
[[boundary]]
on = "bottom"
displacement = { x = 0, y = 0 }
[[boundary]]
on = "head"
rigid = { x = 0, rotation = 0, force = [0, -)") + force + R"(] }
[[contact]]
between = ["foot", "top"]
)"),
                                   {{"accuracy.value", "1%"}, {"accuracy.first_edges", edges}});
    const auto r = solve_to_accuracy(scene);
    ASSERT_TRUE(r && r->accuracy->reached()) << radius;
    EXPECT_EQ(r->status, Status::solved) << radius;
    EXPECT_TRUE(r->estimate->pressures[0].singular.empty()) << radius;
    EXPECT_LE(r->accuracy->solves.size(), 4u) << radius;
    const ContactPair& pair = r->problem.pairs[0];
    for (const EdgeSamples& edge : pair.multiplier.samples) EXPECT_EQ(edge.pieces.size(), 1u) << radius;
  }
}

// A roller whose profile is Lundberg's, -drop ln(1 - 0.998 x^2) on half its length, on a flat block.
std::string profiled_roller(double drop) {
  constexpr int points = 9;
  std::ostringstream out;
  out.precision(17);
  for (int i = 0; i < points; ++i) {
    const double x = -1 + 2. * i / (points - 1);
    out << "Point(" << i + 1 << ") = {" << x << ", " << -drop * std::log(1 - 0.998 * x * x) << ", 0};\n";
  }
  out << R"(Spline(1) = {1:9}; Point(10) = {1, 0.6, 0}; Point(11) = {-1, 0.6, 0};
Line(2) = {9, 10}; Line(3) = {10, 11}; Line(4) = {11, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Point(21) = {-1.6, -1, 0}; Point(22) = {1.6, -1, 0}; Point(23) = {1.6, 0, 0}; Point(24) = {-1.6, 0, 0};
Line(21) = {21, 22}; Line(22) = {22, 23}; Line(23) = {23, 24}; Line(24) = {24, 21};
Curve Loop(2) = {21:24}; Plane Surface(2) = {2};
Physical Surface("roller") = {1}; Physical Surface("block") = {2};
Physical Curve("crown") = {1}; Physical Curve("head") = {3}; Physical Curve("bottom") = {21}; Physical Curve("top") = {23};
)";
  return out.str();
}

// On a first mesh contact reaches the ends of a profile, where p would have no limit; on finer ones it ends before.
// (The block's top may carry the multipliers, and is longer.)
TEST(Accuracy, DropsAnEndThatContactReachesOnTheFirstMeshAlone) {
  std::mt19937 random(3);
  const auto power_of_ten = [&](double low, double high) {
    return std::pow(10, std::uniform_real_distribution<double>(low, high)(random));
  };
  int reached = 0, on_first = 0;
  for (int k = 0; k < 16; ++k) {
    const TemporaryFolder folder;
    folder.write("a.geo", profiled_roller(power_of_ten(-3.7, -2.7)));
    const std::string file = folder.write("a.toml", R"(
mesh.file = "a.geo"
materials.steel = { young = 210e3, poisson = 0.3 }
bodies = { roller = "steel", block = "steel" }
boundary = [{ on = "bottom", displacement = { x = 0, y = 0 } },
            { on = "head", displacement = { x = 0, y = -)" +
                                                        std::to_string(power_of_ten(-3.2, -2)) +
                                                        R"( } }]
contact = [{ between = ["crown", "top"] }]
)");
    const auto answer = [&](const char* accuracy, const char* edges) {
      auto r = solve_to_accuracy(read_scene(file, {{"accuracy.value", accuracy}, {"accuracy.first_edges", edges}}));
      EXPECT_TRUE(r && r->accuracy->reached()) << k;
      return *std::move(r);
    };
    const auto ends = [](const Results& r) { return r.estimate->pressures[0].singular.size(); };
    const Results fine = answer("0.5%", "40");
    const double length = fine.recovery.contacts[0].length_in_contact;
    if (ends(fine) > 0) {
      EXPECT_EQ(ends(answer("3%", "5")), 2u) << k;
      ++reached;
    } else if (length < 0.98 * 2) {
      EXPECT_EQ(ends(answer("3%", "5")), 0u) << k << ", in contact along " << length;
      on_first += ends(answer("50%", "5")) > 0;
    }
  }
  EXPECT_GT(reached, 1);
  EXPECT_GT(on_first, 1);
}

// Contact is shorter than the edges of the first meshes: on some of them only the middle of one presses, as of an odd
// number of edges under the lowest point of a ball.
TEST(Accuracy, IsNotThatOfNothingWhereOnlyTheMiddleOfAnEdgePresses) {
  const TemporaryFolder folder;
  folder.write("a.geo", R"(
DefineConstant[R = 1];
x = 0.6 * R; y = R - Sqrt(R * R - x * x);
Point(1) = {-x, y, 0}; Point(2) = {0, 0, 0}; Point(3) = {x, y, 0}; Point(4) = {x, y + 1, 0}; Point(5) = {-x, y + 1, 0}; Point(6) = {0, R, 0};
Circle(1) = {1, 6, 2}; Circle(2) = {2, 6, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Curve Loop(1) = {1 : 5}; Plane Surface(1) = {1};
Point(11) = {-4, -3, 0}; Point(12) = {4, -3, 0}; Point(13) = {4, 0, 0}; Point(14) = {-4, 0, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(2) = {11 : 14}; Plane Surface(2) = {2};
Physical Surface("ball") = {1}; Physical Surface("block") = {2};
Physical Curve("skin") = {1, 2}; Physical Curve("face") = {13}; Physical Curve("head") = {4}; Physical Curve("floor") = {11};
)");
  std::mt19937 random(8);
  const auto power_of_ten = [&](double low, double high) {
    return std::pow(10, std::uniform_real_distribution<double>(low, high)(random));
  };
  for (int k = 0; k < 10; ++k) {
    const std::string file = folder.write("a.toml", R"(
mesh = { file = "a.geo", parameters = { R = )" + std::to_string(power_of_ten(0, 1)) +
                                                        R"( } }
materials.one = { young = 1, poisson = 0.3 }
materials.other = { young = )" + std::to_string(power_of_ten(0, 1.5)) +
                                                        R"(, poisson = 0.3 }
bodies = { ball = "other", block = "one" }
boundary = [{ on = "floor", displacement = { x = 0, y = 0 } },
            { on = "head", displacement = { x = 0, y = -)" +
                                                        std::to_string(power_of_ten(-4, -2.5)) +
                                                        R"( } }]
contact = [{ between = ["skin", "face"], multipliers_on = "face" }]
)");
    const auto force = [&](const char* multipliers, const std::string& edges) {
      const auto r = solve_to_accuracy(read_scene(
          file, {{"accuracy.value", "3%"}, {"accuracy.first_edges", edges}, {"method.multipliers", multipliers}}));
      EXPECT_TRUE(r && r->accuracy->reached()) << k;
      return r->recovery.contacts[0].force.y();
    };
    const double exact = force("linear", "20");
    EXPECT_NEAR(force(k % 2 ? "quadratic" : "dual", std::to_string(3 + random() % 12)) / exact, 1, 0.02) << k;
  }
}

// Two bodies pressed together along a joint that leans, drawn at random: at its ends p goes as a small power of the
// distance, which falls as the root of the edges' length.
TEST(Accuracy, OfLeaningJointsTakesFewSolves) {
  const TemporaryFolder folder;
  std::mt19937 draw(40);
  const auto between = [&](double from, double to) { return std::uniform_real_distribution(from, to)(draw); };
  for (int k = 0; k < 5; ++k) {
    const double lean = between(0.5, 2) * (k % 2 == 0 ? 1 : -1);
    std::ostringstream geo;
    geo << "a = " << lean << R"(;
Point(1) = {-20, 0, 0}; Point(2) = {a, 0, 0}; Point(3) = {-a, 10, 0}; Point(4) = {-20, 10, 0};
Point(5) = {a, 0, 0}; Point(6) = {20, 0, 0}; Point(7) = {20, 10, 0}; Point(8) = {-a, 10, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Curve Loop(1) = {1 : 4}; Curve Loop(2) = {5 : 8}; Plane Surface(1) = {1}; Plane Surface(2) = {2};
Physical Surface("l") = {1}; Physical Surface("r") = {2}; Physical Curve("left") = {4}; Physical Curve("right") = {6};
Physical Curve("l_joint") = {2}; Physical Curve("r_joint") = {8}; Physical Curve("base") = {5};
MeshSize{:} = 1;
)";
    folder.write("s.geo", geo.str());
    const auto r = solve_to_accuracy(read_scene(folder.write("s.toml", R"(
mesh.file = "s.geo"
materials = { soft = { young = 70e3, poisson = 0.33 }, hard = { young = )" +
                                                                           std::to_string(between(50e3, 400e3)) +
                                                                           R"(, poisson = 0.3 } }
bodies = { l = "soft", r = "hard" }
boundary = [
  { on = "left", displacement = { x = 0, y = 0 } },
  { on = "right", displacement = { x = -0.01 } }, { on = "base", displacement = { y = 0 } },
]
contact = [{ between = ["l_joint", "r_joint"], initial_gap = "closed" }]
accuracy.value = "0.3%"
)")));
    ASSERT_TRUE(r && r->accuracy->reached()) << lean;
    EXPECT_LE(r->accuracy->solves.size(), 4u) << lean;
  }
}

// A roller drawn into a block, its curve inside the block: edges as short as those of a roller that is drawn touching.
TEST(Accuracy, OfRoundBodiesDrawnIntoOthersIsReached) {
  const TemporaryFolder folder;
  for (const double overlap : {0.2, 0.05, 0.01, 0.})
    for (const char* side : {"rim", "top"}) {
      std::ostringstream geo;
      geo << "d = " << overlap << R"(;
Point(1) = {0, 4 - d, 0}; Point(2) = {0, -d, 0}; Point(3) = {4, 4 - d, 0}; Circle(1) = {2, 1, 3};
Line(2) = {3, 1}; Line(3) = {1, 2}; Curve Loop(1) = {1 : 3}; Plane Surface(1) = {1};
Point(4) = {0, -9, 0}; Point(5) = {9, -9, 0}; Point(6) = {9, 0, 0}; Point(7) = {0, 0, 0};
Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 4}; Curve Loop(2) = {4 : 7}; Plane Surface(2) = {2};
Physical Surface("roller") = {1}; Physical Surface("block") = {2}; Physical Curve("axis") = {3, 7};
Physical Curve("rim") = {1}; Physical Curve("top") = {6}; Physical Curve("ground") = {4}; Physical Curve("head") = {2};
MeshSize{:} = 1.5;
)";
      folder.write("s.geo", geo.str());
      const auto r = solve_to_accuracy(read_scene(folder.write("s.toml", R"(
mesh.file = "s.geo"
materials.steel = { young = 210e3, poisson = 0.3 }
bodies = { "*" = "steel" }
boundary = [
  { on = "axis", displacement = { x = 0 } }, { on = "ground", displacement = { y = 0 } },
  { on = "head", pressure = 100 },
]
contact = [{ between = ["rim", "top"], multipliers_on = ")" + std::string(side) +
                                                                             R"(" }]
accuracy.value = "1%"
)")));
      ASSERT_TRUE(r && r->accuracy->reached()) << overlap << " " << side;
      EXPECT_LE(r->accuracy->solves.size(), 5u) << overlap << " " << side;
      EXPECT_LE(free_unknowns(*r), 20000) << overlap << " " << side;
    }
}

// Ten pairs of plates that hardly touch, some on soft foundations: of 500 rows, the path through the interior tells
// which are closed only at its end, past where round-off rises.
TEST(Accuracy, OfARivetedJointHasAnActiveSetOnEachMesh) {
  Scene scene = read_scene(std::string(MORTISE_SOURCE_DIR) + "/tests/parts/riveted_joint.toml",
                           {{"accuracy.value", "1%"}, {"accuracy.solves_max", "6"}});
  const auto r = solve_to_accuracy(scene);
  ASSERT_TRUE(r);
  for (const auto& solve : r->accuracy->solves) EXPECT_TRUE(std::isfinite(solve.estimated));
}

// One pair carries a thousandth of the forces at its corner, where p goes as r^-0.504 and has no norm.
TEST(Accuracy, OfARivetedJointLeavesOutACornerWhoseForceIsNotSeen) {
  const auto r = solve_to_accuracy(read_scene(std::string(MORTISE_SOURCE_DIR) + "/tests/parts/riveted_joint.toml",
                                              {{"accuracy.value", "1%"},
                                               {"accuracy.first_edges", "27"},
                                               {"materials.steel", "{ young = 63e3, poisson = 0.45 }"},
                                               {"materials.aluminium", "{ young = 70e3, poisson = 0.45 }"}}));
  ASSERT_TRUE(r && r->accuracy->reached());
  EXPECT_LE(r->accuracy->solves.size(), 5u);
  const PressureEstimate& e = r->estimate->pressures[1];
  EXPECT_GT(e.line.p.maxCoeff(), 0);
  EXPECT_EQ(e.p2, 0);
}

// It turns on the rounded edge of its foot, and slides across where that begins: contact goes on there by what normals
// that turn make of the slide, within 1e-4, and p would grow to 50 GPa.
TEST(Accuracy, OfAKeyLeavesOutWhereItSlidesAcrossTheBeginOfItsFillet) {
  const auto r = solve_to_accuracy(
      read_scene(std::string(MORTISE_SOURCE_DIR) + "/tests/parts/key.toml", {{"accuracy.value", "5%"}}));
  ASSERT_TRUE(r && r->accuracy->reached());
  EXPECT_TRUE(std::ranges::any_of(r->estimate->pressures[0].singular, [](const SingularPoint& point) {
    return point.log_pressure > 0 && (point.position - Vec2(-7, 24.5)).norm() < 1e-6;
  }));
  EXPECT_LE(r->accuracy->solves.size(), 6u);
  EXPECT_LE(free_unknowns(*r), 35000);
}

// Of two of them the exponents are others than those of the three that meet.
TEST(Accuracy, OfABlockOnTwoKnowsThePowerOfAllThreeBodies) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0.25, 0.95), power(-1, 1);
  int unbounded = 0;
  for (int k = 0; k < 4; ++k) {
    std::vector<Override> drawn{{"accuracy.value", "0.3%"}, {"accuracy.solves_max", "5"}};
    for (const char* end : {"bottom", "top"})
      drawn.push_back({std::string("mesh.parameters.") + end, std::to_string(k == 0 ? 0.6 : place(random))});
    for (const char* body : {"left", "right", "block"})
      drawn.push_back(
          {std::string("materials.") + body + ".young", std::to_string(30e9 * std::pow(10, power(random)))});
    const auto r =
        solve_to_accuracy(read_scene(std::string(MORTISE_SOURCE_DIR) + "/tests/parts/block_on_two.toml", drawn));
    ASSERT_TRUE(r) << k;
    EXPECT_EQ(r->status, Status::solved) << k;
    for (const SingularPoint& point : r->estimate->pressures[0].singular)
      unbounded += point.is_unbounded() && point.position.y() > 0.5;
  }
  EXPECT_GE(unbounded, 2);
}

}  // namespace
}  // namespace mortise::test
