// A bolt that clamps a sleeve: overlaps and forces against springs in parallel (VDI 2230's cylinder), which uniform
// stresses make exact.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "app/cases.hpp"
#include "app/gradients.hpp"
#include "app/solve_scene.hpp"
#include "results/report.hpp"
#include "results/report_text.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// A shank that is cut at half its height, in one piece with a head on its top, and a sleeve beside it below the head.
const std::string bolt = R"(
Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 2, 0}; Point(4) = {0, 2, 0};
Point(5) = {0, 2, 0}; Point(6) = {1, 2, 0}; Point(7) = {1, 4, 0}; Point(8) = {0, 4, 0};
Point(9) = {3, 4, 0}; Point(10) = {3, 5, 0}; Point(11) = {1, 5, 0}; Point(12) = {0, 5, 0};
Point(13) = {1.5, 0, 0}; Point(14) = {2.5, 0, 0}; Point(15) = {2.5, 4, 0}; Point(16) = {1.5, 4, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Line(9) = {7, 9}; Line(10) = {9, 10}; Line(11) = {10, 11}; Line(12) = {11, 12}; Line(13) = {12, 8}; Line(14) = {7, 11};
Line(15) = {13, 14}; Line(16) = {14, 15}; Line(17) = {15, 16}; Line(18) = {16, 13};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5 : 8}; Plane Surface(2) = {2};
Curve Loop(3) = {9, 10, 11, -14}; Plane Surface(3) = {3};
Curve Loop(4) = {-7, 14, 12, 13}; Plane Surface(4) = {4};
Curve Loop(5) = {15 : 18}; Plane Surface(5) = {5};
Transfinite Curve{1, 3} = 4; Transfinite Curve{2, 4} = 4; Transfinite Curve{5, 7, 12} = 2; Transfinite Curve{6, 8} = 5;
Transfinite Curve{9, 11} = 2; Transfinite Curve{10, 13, 14} = 2; Transfinite Curve{15, 17} = 4;
Transfinite Curve{16, 18} = 3;
Transfinite Surface{1 : 5}; Recombine Surface{1 : 5};
Physical Surface("lower") = {1}; Physical Surface("upper") = {2}; Physical Surface("head") = {3, 4};
Physical Surface("sleeve") = {5};
Physical Curve("foot") = {1, 15}; Physical Curve("axis") = {4, 8, 13};
Physical Curve("lower_cut") = {3}; Physical Curve("upper_cut") = {5};
Physical Curve("neck") = {7, 14}; Physical Curve("outer_neck") = {10}; Physical Curve("head_top") = {11, 12};
Physical Curve("seat") = {9}; Physical Curve("sleeve_top") = {17};
)";

constexpr double bolt_young = 1000, shank_length = 4, preload = 3;

// `tie`: more of the pair's keys; `load`: on the head; `rest` begins with a section.
struct Joint {
  std::string plane = "strain", tie = "pretension = 3", load = "0", rest = {};
};

Scene scene_of(const TemporaryFolder& folder, const Joint& joint) {
  folder.write("bolt.geo", bolt);
  const bool rings = joint.plane == "axisymmetric";
  const std::string axis = rings ? "" : "[[boundary]]\non = \"axis\"\ndisplacement = { x = 0 }\n",
                    guided = rings ? "" : "x = 0, rotation = 0, ";
  return read_scene(folder.write("scene.toml", "mesh.file = \"bolt.geo\"\nmodel.plane = \"" + joint.plane + R"("
materials.m = { young = 1000, poisson = 0 }
bodies = { "*" = "m" }
[[contact]]
between = ["lower_cut", "upper_cut"]
condition = "tied"
)" + joint.tie + R"(
[[contact]]
between = ["sleeve_top", "seat"]
initial_gap = "closed"
[[boundary]]
on = "foot"
displacement = { x = 0, y = 0 }
[[boundary]]
on = ["neck", "outer_neck", "head_top", "seat"]
rigid = { )" + guided + "force = [0, " + joint.load +
                                                   "] }\n" + axis + joint.rest));
}

// Areas of shank and sleeve, and their stiffnesses.
struct Springs {
  explicit Springs(const std::string& plane)
      : shank(plane == "axisymmetric" ? std::numbers::pi : 1), sleeve(plane == "axisymmetric" ? 4 * shank : shank) {}
  double of_shank() const { return bolt_young * shank / shank_length; }
  double of_sleeve() const { return bolt_young * sleeve / shank_length; }
  // Of a load on the head what the bolt bears while the joint is closed.
  double share() const { return of_shank() / (of_shank() + of_sleeve()); }
  double shank, sleeve;
};

double overlap(const Results& r) { return r.recovery.reactions.overlaps.at(0); }

// What pulls the halves of the shank together.
double tension(const Results& r) {
  return r.recovery.reactions.ties[0].force.dot(r.problem.mesh.ties[0].pretension->normal);
}

// On both sides the shank has its force, and the sleeve presses against the head with it.
void expect_joint(const Results& r, const Springs& springs, double of_bolt, double of_sleeve) {
  EXPECT_EQ(r.status, Status::solved);
  EXPECT_EQ(r.warnings.size(), 0u) << (r.warnings.empty() ? "" : r.warnings[0]);
  EXPECT_NEAR(tension(r), of_bolt, 1e-10 * preload);
  const VecX& p = r.recovery.contacts[0].pressure;
  EXPECT_LE(largest_entry(p - VecX::Constant(p.size(), of_sleeve / springs.sleeve)), 1e-10 * preload);
  EXPECT_NEAR(overlap(r), of_bolt / springs.of_shank() + of_sleeve / springs.of_sleeve(),
              1e-10 * preload / springs.of_shank());
  const Mesh& mesh = r.problem.mesh;
  for (const Cell& cell : mesh.cells)
    if (const std::string& body = mesh.bodies[cell.body]; body == "lower" || body == "upper")
      for (int a = 0; a < node_count(cell.kind); ++a) {
        const double y = mesh.nodes(cell.nodes[a], 1), stretched = of_bolt / springs.of_shank() * y / shank_length;
        EXPECT_NEAR(r.solution.u(2 * cell.nodes[a] + 1), stretched - (body == "upper" ? overlap(r) : 0),
                    1e-10 * preload / springs.of_shank());
      }
}

TEST(Pretension, StretchesABoltAndPressesItsSleeve) {
  const TemporaryFolder folder;
  for (const std::string plane : {"strain", "stress", "axisymmetric"})
    for (const std::string follows : {"lower_cut", "upper_cut"}) {
      SCOPED_TRACE(plane + ", " + follows);
      const Springs springs(plane);
      const Results r = solve_scene(
          scene_of(folder, {.plane = plane, .tie = "pretension = 3\nmultipliers_on = \"" + follows + "\""}));
      EXPECT_EQ(r.problem.mesh.ties[0].curves[0], follows);
      expect_joint(r, springs, preload, preload);
    }
}

TEST(Pretension, IsTheForceUnderAllLoadsUnlessItIsLocked) {
  const TemporaryFolder folder;
  for (const std::string plane : {"strain", "axisymmetric"}) {
    SCOPED_TRACE(plane);
    const Springs springs(plane);
    expect_joint(solve_scene(scene_of(folder, {.plane = plane, .load = "1"})), springs, 3, 2);
  }
}

// The load on the head is shared by the stiffnesses until the sleeve is loose, and all the bolt's then.
TEST(Pretension, LockedSharesALoadByStiffnesses) {
  const TemporaryFolder folder;
  for (const std::string plane : {"strain", "axisymmetric"})
    for (const double load : {1.0, -2.0}) {
      SCOPED_TRACE(plane);
      const Springs springs(plane);
      const double share = springs.share() * load;
      expect_joint(solve_scene(scene_of(
                       folder, {.plane = plane, .tie = "pretension = 3\nlocked = true", .load = std::to_string(load)})),
                   springs, preload + share, preload - load + share);
    }
  const Results loose = solve_scene(scene_of(folder, {.tie = "pretension = 3\nlocked = true", .load = "7"}));
  EXPECT_NEAR(tension(loose), 7, 1e-10 * 7);
  EXPECT_EQ(loose.recovery.contacts[0].length_in_contact, 0);
}

// What the overlap of a pretension is as a number gives its force.
TEST(Pretension, IsWhatItsOverlapGives) {
  const TemporaryFolder folder;
  const Springs springs("strain");
  const double drawn = preload / springs.of_shank() + preload / springs.of_sleeve();
  const Results r = solve_scene(scene_of(folder, {.tie = "overlap = " + std::to_string(drawn)}));
  expect_joint(r, springs, preload, preload);
  const Json tie = report_of(r)["model"]["ties"][0];
  EXPECT_FALSE(tie.contains("pretension"));
  EXPECT_NEAR(tie["tension"].get<double>(), preload, 1e-10);
  expect_contains(model_text(report_of(r)["model"]), "; overlap 0.024, tension 3\n");
}

TEST(Pretension, IsCarriedByEverySolver) {
  const TemporaryFolder folder;
  for (const std::string solver : {"mssor", "ddm", "feti"})
    for (const std::string locked : {"false", "true"}) {
      SCOPED_TRACE(solver + locked);
      const Results r =
          solve_scene(scene_of(folder, {.tie = "pretension = 3\nlocked = " + locked,
                                        .load = "1",
                                        .rest = "[method]\nsolver = \"" + solver + "\"\ntolerance = 1e-10\n"}));
      EXPECT_EQ(r.status, Status::solved);
      EXPECT_NEAR(tension(r), locked == "true" ? 3.5 : 3, 1e-7);
      EXPECT_NEAR(overlap(r), locked == "true" ? 0.024 : 0.02, 1e-7);
    }
}

// Cases of loads have one factor, with the overlap locked.
TEST(Pretension, CasesShareTheFactorOfALockedJoint) {
  const TemporaryFolder folder;
  const Scene scene = scene_of(folder, {.tie = "pretension = 3\nlocked = true",
                                        .load = "1",
                                        .rest = "[[case]]\nname = \"load\"\nscale = [0, 1, 2]\n"
                                                "[[case]]\ncontact.0.pretension = 6\n"});
  std::vector<double> tensions;
  const CaseTable table =
      solve_cases(scene, {}, {}, [&](const LoadCase&, Results& r) { tensions.push_back(tension(r)); });
  ASSERT_EQ(tensions.size(), 4u);
  const double expected[] = {3, 3.5, 4, 6.5};
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(tensions[k], expected[k], 1e-9);
  EXPECT_EQ(table.shared, 2);
  const auto told =
      std::ranges::find(table.rows.at(3).figures, "tie.0.tension", &std::pair<std::string, double>::first);
  ASSERT_NE(told, table.rows.at(3).figures.end());
  EXPECT_NEAR(told->second, 6.5, 1e-9);
}

// So do those of another pretension where nothing is locked.
TEST(Pretension, IsALoadOfItsOwnFactor) {
  const TemporaryFolder folder;
  CaseSolver solver;
  for (const std::string given : {"pretension = 3", "pretension = 5", "overlap = 0.024", "overlap = 0.04"})
    EXPECT_NEAR(overlap(solver.solve(scene_of(folder, {.tie = given}))),
                given == "pretension = 3"    ? 0.024
                : given == "pretension = 5"  ? 0.04
                : given == "overlap = 0.024" ? 0.024
                                             : 0.04,
                1e-11);
  EXPECT_EQ(solver.shared(), 2);
}

// A clearance below the head is a part of the overlap.
TEST(Pretension, FirstClosesAClearance) {
  const TemporaryFolder folder;
  Scene scene = scene_of(folder, {});
  scene.contacts[0].initial_gap = InitialGap::given;
  scene.contacts[0].gap = Field(0.01);
  const Results r = solve_scene(scene);
  EXPECT_NEAR(overlap(r), 0.024 + 0.01, 1e-11);
  EXPECT_NEAR(tension(r), 3, 1e-10);
}

// Castigliano: energy by force is overlap, energy by overlap is force.
TEST(Pretension, HasGradients) {
  const TemporaryFolder folder;
  const auto slopes = [&](const std::string& tie, const std::string& key, double value) {
    const std::string path = scene_of(folder, {.tie = tie}).path;
    const std::vector<Parameter> by{{key, value}};
    const Results r = solve_scene(parametrised(path, {}, by));
    return gradients(r, path, {}, {{"energy", {}}, {"contact.1.pressure.mean", {}}}, by).derivatives;
  };
  const MatX by_force = slopes("pretension = 3", "contact.0.pretension", 3);
  EXPECT_NEAR(by_force(0), 0.024, 1e-9);
  EXPECT_NEAR(by_force(1), 1, 1e-9);
  const MatX by_overlap = slopes("overlap = 0.024", "contact.0.overlap", 0.024);
  EXPECT_NEAR(by_overlap(0), 3, 1e-7);
  EXPECT_NEAR(by_overlap(1), 125, 1e-6);
  const MatX by_modulus = slopes("pretension = 3", "materials.m.young", 1000);
  EXPECT_NEAR(by_modulus(0), -3 * 0.024 / 2 / 1000, 1e-9);
  expect_contains(message_of([&] { slopes("pretension = 3\nlocked = true", "materials.m.young", 1000); }),
                  "has no gradient here");
}

// An elastic head in a guide: the same however it lies.
TEST(Pretension, IsTheSameAlongAnyDirection) {
  const auto solved = [](const std::string& turn, const std::string& given) {
    const TemporaryFolder folder;
    folder.write("bolt.geo", bolt + turn);
    return solve_scene(read_scene(folder.write("scene.toml", R"(mesh.file = "bolt.geo"
materials.m = { young = 1000, poisson = 0.3 }
bodies = { "*" = "m" }
contact = [
  { between = ["lower_cut", "upper_cut"], condition = "tied", )" +
                                                                 given + R"( },
  { between = ["sleeve_top", "seat"], initial_gap = 0 },
]
boundary = [{ on = "foot", displacement = { x = 0, y = 0 } }, { on = "outer_neck", displacement = { normal = 0 } }]
)")));
  };
  const Results upright = solved("", "pretension = 3");
  for (const std::string angle : {"0.5", "2", "Pi / 2"}) {
    SCOPED_TRACE(angle);
    const std::string turn =
        "Geometry.AutoCoherence = 0;\nRotate {{0, 0, 1}, {0, 0, 0}, " + angle + "} { Surface{1 : 5}; }\n";
    for (const std::string given : {std::string("pretension = 3"), "overlap = " + std::to_string(overlap(upright))}) {
      const Results turned = solved(turn, given);
      EXPECT_EQ(turned.status, Status::solved);
      EXPECT_NEAR(overlap(turned), overlap(upright), given[0] == 'p' ? 1e-11 : 1e-6);
      EXPECT_NEAR(tension(turned), 3, given[0] == 'p' ? 1e-10 : 1e-3);
      EXPECT_NEAR(turned.recovery.energy, upright.recovery.energy,
                  (given[0] == 'p' ? 1e-9 : 1e-3) * upright.recovery.energy);
    }
  }
}

// A support that holds an end of the cut along its normal takes nothing from the mean overlap.
TEST(Pretension, KeepsTheMeanOverlapBesideASupport) {
  const TemporaryFolder folder;
  Scene scene = scene_of(folder, {.tie = "overlap = 0.1\nmultipliers_on = \"lower_cut\""});
  folder.write("bolt.geo", bolt + "Physical Point(\"pin\") = {3};\n");
  scene.boundaries.push_back({.key = "pin", .on = {"pin"}, .what = Displacement{.x = {}, .y = Field()}});
  const Results r = solve_scene(scene);
  const Tie& tie = r.problem.mesh.ties[0];
  double mean = 0, whole = 0;
  for (const TiedNode& one : tie.nodes) {
    double jump = r.solution.u(2 * one.node + 1);
    for (const auto& [node, weight] : one.weights) jump -= weight * r.solution.u(2 * node + 1);
    mean += one.area * jump;
    whole += one.area;
  }
  EXPECT_NEAR(mean / whole, 0.1, 1e-12);
}

// `geo`: the drawing with some of its text replaced; `joint.rest` may hold a pair or a method.
std::string told(const Joint& joint, const std::vector<std::pair<std::string, std::string>>& changes = {}) {
  const TemporaryFolder folder;
  return message_of([&] {
    const Scene scene = scene_of(folder, joint);
    std::string geo = bolt;
    for (const auto& [from, to] : changes) geo.replace(geo.find(from), from.size(), to);
    folder.write("bolt.geo", geo);
    solve_scene(scene);
  });
}

TEST(Pretension, RefusesKeysThatDoNotGoTogether) {
  expect_contains(told({.tie = "pretension = 3\noverlap = 0.1"}),
                  "contact.0.overlap: is what a pretension makes; expected one of pretension and overlap");
  expect_contains(told({.tie = "overlap = 0.1\nlocked = true"}),
                  "goes with pretension, the force before all other loads; overlap is locked by itself");
  expect_contains(told({.tie = "pretension = nan"}), "contact.0.pretension");
  expect_contains(told({.tie = "preload = 3"}), "contact.0: unknown key 'preload'");
  expect_contains(told({.rest = "[[contact]]\nbetween = [\"foot\", \"axis\"]\npretension = 3\n"}),
                  "goes with condition = \"tied\", a cut through one body that is drawn together");
}

TEST(Pretension, RefusesCutsThatAreNotStraight) {
  const std::vector<std::pair<std::string, std::string>> arcs{
      {"Line(3) = {3, 4}", "Point(20) = {0.5, -10, 0}; Circle(3) = {3, 20, 4}"},
      {"Line(5) = {5, 6}", "Circle(5) = {5, 20, 6}"}};
  expect_contains(told({}, arcs), "contact.0 (line 5).pretension: 'lower_cut' is not straight near (");
  expect_contains(told({.tie = "overlap = 0.1"}, arcs),
                  "contact.0 (line 5).overlap: 'lower_cut' is not straight near (");
  expect_contains(told({.plane = "axisymmetric"}, {{"{1, 2, 0}; Point(4)", "{1, 2.1, 0}; Point(4)"},
                                                   {"Point(6) = {1, 2, 0}", "Point(6) = {1, 2.1, 0}"}}),
                  "is not straight across the axis near (1, 2.1); expected a straight cut, whose nodes have one y");
}

TEST(Pretension, RefusesWhatNothingCarriesOrLets) {
  const std::string held = "[[boundary]]\non = [\"lower_cut\", \"upper_cut\"]\ndisplacement = { y = 0 }\n";
  Joint joint{.rest = held};
  expect_contains(told(joint),
                  "supports or other ties hold all nodes of 'lower_cut' along its normal; expected "
                  "multipliers_on the other curve, or a cut that nothing holds");
  expect_contains(told({.tie = "pretension = -3"}), "nothing holds body 'upper'");
  expect_contains(
      told({.tie = "pretension = 3\nlocked = true", .rest = "[method]\nsolver = \"mssor\"\nmax_iterations = 1\n"}),
      "the solution under pretension alone, which the overlaps are from, has not converged");
}

}  // namespace
}  // namespace mortise::test
