// A contact line that moves farther than small displacements bear, p that no mesh bears out, and curves that are not
// one.
#include "results/line_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include "app/solve_scene.hpp"
#include "results/error_report.hpp"
#include "results/large_displacement.hpp"
#include "results/line_motion.hpp"
#include "support/messages.hpp"
#include "support/plate_scenes.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// Bottom and top move as a turn by atan(slope) and a slide of the upper plate would move them, and are pressed
// together.
Results moved(double slope, double slide) {
  const auto prescribed = [&](const std::string& curve, double along, double down) -> BoundarySpec {
    const std::string s = std::to_string(slope);
    return {.key = {},
            .on = {curve},
            .what = Displacement{Field(std::to_string(along) + " - " + s + " * y", {}),
                                 Field(s + " * x - " + std::to_string(down), {})}};
  };
  Scene s = bare_scene();
  s.boundaries = {prescribed("bottom", 0, 0), prescribed("top", slide, 1e-4)};
  return solve_scene(s, mesh_of({}));
}

const Check& motion_of(const Results& r) {
  return *std::ranges::find(r.checks, std::string("turn and slide of contact lines"), &Check::name);
}

TEST(LineMotion, IsTheTurnAndTheSlideOfTheWhole) {
  for (const double slope : {0.0, 0.01, 0.3, 2.5}) {
    const Results r = moved(slope, 0);
    const auto motion = line_motion(r.problem.mesh.nodes, r.problem.pairs[0], r.recovery.contacts[0], r.solution.u);
    ASSERT_TRUE(motion);
    EXPECT_NEAR(motion->turned, std::atan(slope), 1e-3);
    EXPECT_NEAR(motion->slid, 0, 1e-3);
    EXPECT_NEAR((motion->position - Vec2(0.4, 0.3)).norm(), 0, 1e-3);
  }
  const Results r = moved(0, 0.2);
  EXPECT_NEAR(line_motion(r.problem.mesh.nodes, r.problem.pairs[0], r.recovery.contacts[0], r.solution.u)->slid,
              0.2 / 0.8, 1e-3);
}

// Two patches that move apart: each slides by a part of its own length, and neither hides the other.
TEST(LineMotion, OfPatchesIsThatOfEach) {
  Results r = moved(0, 0);
  const ContactPair& pair = r.problem.pairs[0];
  VecX& p = r.recovery.contacts[0].pressure;
  for (std::size_t e = 0; e < pair.multiplier.edges.size(); ++e)
    for (const int a : pair.coupling.on_edge[e])
      if (a >= 0 && std::abs(r.problem.mesh.nodes(pair.multiplier.edges[e].nodes[0], 0) - 0.4) < 0.12) p(a) = 0;
  r.solution.u.setZero();
  for (const Cell& cell : r.problem.mesh.cells)
    if (cell.body == pair.opposite.body)
      for (int i = 0; i < node_count(cell.kind); ++i)
        r.solution.u(2 * cell.nodes[i]) = r.problem.mesh.nodes(cell.nodes[i], 0) < 0.4 ? -0.02 : 0.02;
  const auto motion = line_motion(r.problem.mesh.nodes, pair, r.recovery.contacts[0], r.solution.u);
  ASSERT_TRUE(motion);
  EXPECT_GT(motion->slid, 0.02 / 0.4);
  EXPECT_LT(motion->slid, 0.02 / 0.15);
  EXPECT_GT(motion->shifted, motion->slid / 2);
  EXPECT_GT(std::abs(motion->slid_at.x() - 0.4), 0.1);
  double largest = 0;
  for (const PlaceMotion& place : place_motions(r.problem.mesh.nodes, pair, r.recovery.contacts[0], r.solution.u))
    largest = std::max(largest, double(place.patch));
  EXPECT_EQ(largest, 1);
}

// Tension carries a bonded line as pressure does, and a contact line not at all.
TEST(LineMotion, OfABondedLineInTensionIsThatUnderPressure) {
  Results r = moved(0.3, 0.1);
  const auto motion = [&] {
    return line_motion(r.problem.mesh.nodes, r.problem.pairs[0], r.recovery.contacts[0], r.solution.u);
  };
  r.problem.pairs[0].spec.condition = Condition::unilateral;
  const auto pressed = motion();
  r.recovery.contacts[0].pressure *= -1;
  EXPECT_FALSE(motion());
  r.problem.pairs[0].spec.condition = Condition::bilateral;
  ASSERT_TRUE(motion() && pressed);
  EXPECT_EQ(motion()->turned, pressed->turned);
  EXPECT_EQ(motion()->slid, pressed->slid);
}

TEST(LineChecks, FailWhereALineTurnsOrSlidesByHalf) {
  EXPECT_EQ(moved(0.1, 0.1).status, Status::solved);
  const Results turned = moved(2.5, 0);  // 1.19 radians
  EXPECT_EQ(turned.status, Status::check_failed);
  EXPECT_EQ(motion_of(turned).value, 1);  // all of p is lost
  expect_contains(motion_of(turned).where,
                  "contact.0: the contact line near (0.4, 0.3) turns by 1.2 radians as a whole");
  const Results slid = moved(0, 0.48);
  EXPECT_EQ(slid.status, Status::check_failed);
  expect_contains(motion_of(slid).where, "slides by 60 % of the loaded length");
}

// Beside a pair that does not slide, as its normals lie along the motion, and that presses three times as much.
TEST(LineChecks, CountAPairByItsPartInTheNormOfAllPressure) {
  Results r = moved(0, 0.48);
  r.problem.pairs.push_back(r.problem.pairs[0]);
  for (ContactPoint& point : r.problem.pairs[1].points) point.normal = {1, 0};
  r.recovery.contacts.push_back(r.recovery.contacts[0]);
  r.recovery.contacts[1].pressure *= 3;
  const Check check = motion_check(r);
  EXPECT_TRUE(check.ok());
  EXPECT_NEAR(check.value, motion_of(r).value / std::sqrt(10.0), 1e-6);  // it stretches by 1e-4
}

// Of pairs drawn at random that slide along the same way: where the sum is to be told of, the line that is named is
// that of the pair with the largest part in it, and says of it what it says of that pair alone.
TEST(LineChecks, NameThePairOfWhichMostIsLostHoweverLittleOthersCarry) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  int of_less_sliding = 0, silent = 0;
  for (int variant = 0; variant < 40; ++variant) {
    const Results one = moved(0, 0.1 * unit(random));
    const auto turned = [&](double slide, double pressed) {
      Results r = one;
      for (ContactPoint& point : r.problem.pairs[0].points) point.normal = {std::sqrt(1 - slide * slide), slide};
      r.recovery.contacts[0].pressure *= pressed;
      return r;
    };
    const double slide[] = {1, unit(random)}, pressed[] = {std::pow(10, -3 * unit(random)), 1};
    const Results alone[] = {turned(slide[0], pressed[0]), turned(slide[1], pressed[1])};
    Results both = alone[0];
    both.problem.pairs.push_back(alone[1].problem.pairs[0]);
    both.recovery.contacts.push_back(alone[1].recovery.contacts[0]);
    const auto lost = [&](int k) { return motion_check(alone[k]).value * pressed[k]; };
    const double sum = std::hypot(lost(0), lost(1)) / std::hypot(pressed[0], pressed[1]);
    if (std::abs(sum - 0.01) < 0.003) continue;  // the check takes means, the line places
    const auto said = large_displacement(both).line;
    const auto slides = [](const std::optional<std::string>& line) {
      return line && line->find("slide along one another") != std::string::npos;
    };
    EXPECT_EQ(slides(said), sum > 0.01) << sum;
    silent += !slides(said);
    if (!slides(said) || std::abs(std::log(lost(0) / lost(1))) < 0.3) continue;
    const int most = lost(0) > lost(1) ? 0 : 1;
    EXPECT_EQ(said, large_displacement(alone[most]).line);
    of_less_sliding += most;
  }
  EXPECT_GE(of_less_sliding, 5);
  EXPECT_GE(silent, 3);
}

// Pressed by E, both ends of the foot turn by a radian each, and the line as a whole not at all. It does not
// depend on the mesh, though the corner turns by more on every finer one.
TEST(LineChecks, FailWhereTurnsCancelInTheMeanOfTheLine) {
  for (const char* edges : {"10", "160"}) {
    const Results r = solve_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/punch.toml",
                                             {{"boundary.2.pressure", "2e11"}, {"mesh.parameters.n_punch", edges}}));
    EXPECT_EQ(r.status, Status::check_failed);
    EXPECT_NEAR(motion_of(r).value, 0.643, 0.005);
    expect_contains(motion_of(r).where, ": the contact line near (0.3, 0.2) turns and stretches so that 6");
  }
}

// Pressed by a fifth of E, the surface at the corner of the punch turns by more than a third, and the line not at all.
TEST(LineChecks, HoldWhereASingularCornerTurnsByItself) {
  const Results r =
      solve_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/punch.toml", {{"boundary.2.pressure", "4e10"}}));
  EXPECT_TRUE(motion_of(r).ok()) << motion_of(r).where;
  EXPECT_TRUE(std::ranges::any_of(r.warnings, [](const std::string& line) {
    return line.find("the contact line turns and stretches so that ") != std::string::npos;
  }));
}

TEST(LineChecks, APinThatFallsByHalfItsRadiusFails) {
  const Results r = solve_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/tests/parts/pin_in_hole.toml",
                                           {{"mesh.parameters.clearance", "0.6"}, {"mesh.parameters.drop", "0"}}));
  EXPECT_EQ(r.status, Status::check_failed);
  expect_contains(motion_of(r).where, "of its radius of curvature");
}

// A pin of any radius on a block, in the plane of its cross-section.
Results pin_on_block(const TemporaryFolder& folder, double radius, const std::string& multipliers_on) {
  std::ostringstream geo, toml;
  geo << "SetFactory(\"OpenCASCADE\"); Mesh.ElementOrder = 2; Mesh.MeshSizeMax = " << radius / 8
      << ";\nRectangle(1) = {-4, -2, 0, 8, 2}; Disk(2) = {0, " << radius << ", 0, " << radius << "};\n"
      << R"(Physical Surface("block") = {1}; Physical Surface("pin") = {2};
Physical Curve("ground") = {1}; Physical Curve("track") = {3}; Physical Curve("rim") = {5};)";
  folder.write("pin.geo", geo.str());
  toml << R"(mesh.file = "pin.geo"
materials.steel = { young = 210e3, poisson = 0.3 }
bodies = { "*" = "steel" }
boundary = [{ on = "ground", displacement = { x = 0, y = 0 } }]
body_force = [{ body = "pin", force = [0, -300] }]
contact = [{ between = ["rim", "track"], multipliers_on = ")"
       << multipliers_on << "\" }]\n";
  return solve_scene(read_scene(folder.write("pin.toml", toml.str())));
}

// Contact acts along the pin's normals, and a spin takes these and its rim along themselves; along the block's it does
// not: there the spin is a tilt of the gap.
TEST(LineChecks, ARimMaySpinWhereContactActsAlongItsNormals) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < 4; ++k) {
    const TemporaryFolder folder;
    const double radius = 0.5 + unit(random), angle = std::copysign(0.02 + 0.3 * unit(random), unit(random) - 0.5);
    for (const bool on_rim : {true, false}) {
      Results r = pin_on_block(folder, radius, on_rim ? "rim" : "track");
      for (const Cell& cell : r.problem.mesh.cells)
        for (int a = 0; a < node_count(cell.kind) && r.problem.mesh.bodies[cell.body] == "pin"; ++a) {
          const Vec2 arm = r.problem.mesh.nodes.row(cell.nodes[a]).transpose() - Vec2(0, radius);
          r.solution.u(2 * cell.nodes[a]) = -angle * arm.y();
          r.solution.u(2 * cell.nodes[a] + 1) = angle * arm.x();
        }
      const double lost = motion_check(r).value;
      const std::string told = large_displacement(r).line.value_or("");
      EXPECT_EQ(told.find("slide") != std::string::npos, !on_rim) << told;
      if (on_rim)
        EXPECT_LT(lost, 0.05) << radius << " " << angle;
      else
        EXPECT_EQ(lost, 1) << radius << " " << angle;
    }
  }
}

// A foot, flat up to x = 4 and of radius 3 beyond, on a block that grows under it, by symmetry: `moved` takes the joint
// of line and arc with the foot, which the equations do not. A groove is a block that fits the foot.
Results rounded_foot(const TemporaryFolder& folder, double growth, const std::string& block_side, double moved,
                     bool groove) {
  const auto arc = [](int point, double angle, double size) {
    std::ostringstream text;
    text.precision(17);
    text << "Point(" << point << ") = {" << 4 + 3 * std::sin(angle) << ", " << 3 - 3 * std::cos(angle) << ", 0, "
         << size << "};\n";
    return text.str();
  };
  std::ostringstream geo, toml;
  geo << "Mesh.ElementOrder = 2; Mesh.MeshSizeMax = 1;\n"
      << arc(1, 0, 0.01) << arc(2, 0.05, 0.01) << arc(3, 0.5, 0.3) << arc(11, 0, 0.01)
      << (groove ? arc(12, 0.05, 0.01) + arc(13, 0.5, 0.3)
                 : "Point(12) = {4.15, 0, 0, 0.01}; Point(13) = {10, 0, 0};\n")
      << R"(Point(4) = {4 + 3 * Sin(0.5), 5, 0}; Point(5) = {0, 5, 0}; Point(6) = {0, 0, 0, 0.5}; Point(7) = {4, 3, 0};
Point(14) = {10, -6, 0}; Point(15) = {0, -6, 0}; Point(16) = {0, 0, 0, 0.5};
Line(1) = {6, 1}; Circle(2) = {1, 7, 2}; Circle(3) = {2, 7, 3}; Line(4) = {3, 4}; Line(5) = {4, 5}; Line(6) = {5, 6};
Line(11) = {16, 11}; Line(14) = {13, 14}; Line(15) = {14, 15}; Line(16) = {15, 16};
)" << (groove ? "Circle(12) = {11, 7, 12}; Circle(13) = {12, 7, 13};" : "Line(12) = {11, 12}; Line(13) = {12, 13};")
      << R"(
Curve Loop(1) = {1:6}; Plane Surface(1) = {1}; Curve Loop(2) = {11:16}; Plane Surface(2) = {2};
Physical Surface("foot") = {1}; Physical Surface("block") = {2}; Physical Curve("sole") = {1, 2, 3};
Physical Curve("top") = {11, 12, 13}; Physical Curve("middle") = {6, 16}; Physical Curve("head") = {5};
Physical Curve("ground") = {15};)";
  folder.write("foot.geo", geo.str());
  toml.precision(17);
  toml << R"(mesh.file = "foot.geo"
materials.steel = { young = 200e3, poisson = 0.3, thermal_expansion = 1e-5 }
bodies."*" = "steel"
boundary = [{ on = "middle", displacement = { x = 0 } }, { on = "ground", displacement = { y = 0 } }, { on = "head", pressure = 100 }]
initial_strain = [{ body = "block", temperature_change = )"
       << growth / 4e-5 << R"( }]
contact = [{ between = ["sole", "top"], multipliers_on = ")"
       << block_side << R"(", clearance = "(max(0, x - 4 - )" << moved << ")^2 - max(0, x - 4)^2) / 6\" }]\n";
  return solve_scene(read_scene(folder.write("foot.toml", toml.str())));
}

// Of p in L2, what a run says that a slide across the joint may put it off by; 0 where it says nothing.
double told_of_joint(const Results& r) {
  const std::string told = large_displacement(r).line.value_or("");
  if (told.find("slide along one another where their normals differ by ") == std::string::npos) return 0;
  const std::string before = "p may be off by ";
  return std::stod(told.substr(told.find(before) + before.size())) / 100;
}

double difference(const Results& one, const Results& other) {
  const ContactPair& pair = one.problem.pairs[0];
  double off = 0, whole = 0;
  for (const ContactPoint& point : pair.points) {
    const auto p = [&](const Results& r) {
      return interpolate(pair, r.recovery.contacts[0].pressure, {point.edge, point.xi});
    };
    off += std::pow(p(one) - p(other), 2) * point.ds;
    whole += std::pow(p(one), 2) * point.ds;
  }
  return std::sqrt(off / whole);
}

// What is told is what moving the joint by the slide does to p, to a factor of two or so; without a slide and where
// both sides have the joint there is nothing to tell.
TEST(LineChecks, TellOfSlidesAcrossAJointHowFarPIsOff) {
  const TemporaryFolder folder;
  const double growth = 0.01;
  const Results drawn = rounded_foot(folder, growth, "top", 0, false);
  const double measured = difference(drawn, rounded_foot(folder, growth, "top", -growth, false));
  const double told = told_of_joint(drawn);
  EXPECT_GT(told, measured / 1.5) << measured;
  EXPECT_LT(told, 2.5 * measured) << measured;
  EXPECT_NEAR(told_of_joint(rounded_foot(folder, growth, "sole", 0, false)), told, told / 2);
  EXPECT_EQ(told_of_joint(rounded_foot(folder, growth, "top", 0, true)), 0);
  EXPECT_EQ(told_of_joint(rounded_foot(folder, 0, "top", 0, false)), 0);
}

TEST(LineChecks, APressureThatIsOffByMoreThanHalfFails) {
  Results coarse = solve_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/tests/parts/v_block.toml"));
  EXPECT_EQ(coarse.status, Status::solved);
  estimate(coarse);
  EXPECT_EQ(coarse.status, Status::check_failed);
  EXPECT_EQ(coarse.checks.back().name, "estimated error of p");
  expect_contains(coarse.checks.back().where, "border of contact of 'shaft_foot' on 'flank' near (");
  Results fine = solve_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/hertz.toml"));
  estimate(fine);
  EXPECT_EQ(fine.status, Status::solved);
  fine.estimate->pressures[0].local2 = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(estimate_check(fine)->ok());
}

// A pad that carries nearly all, and at random places beside it a pin of any radius: alone, no edge tells its contact.
TEST(LineChecks, APairThatIsNotResolvedFailsBesideAnyOther) {
  const TemporaryFolder folder;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int variant = 0; variant < 4; ++variant) {
    const double radius = 1 + unit(random), force = std::pow(10, 2 * unit(random)), x = 40 + 15 * unit(random);
    std::ostringstream geo, toml;
    geo << "SetFactory(\"OpenCASCADE\"); Mesh.ElementOrder = 2; Mesh.MeshSizeMax = 1.5;\n"
        << "Rectangle(1) = {0, -10, 0, 60, 10}; Rectangle(2) = {0, 0, 0, 30, 8}; Disk(3) = {" << x << ", " << radius
        << ", 0, " << radius << "};\n"
        << R"(Physical Surface("block") = {1}; Physical Surface("pad") = {2}; Physical Surface("pin") = {3};
Physical Curve("ground") = {1}; Physical Curve("track") = {3}; Physical Curve("foot") = {5}; Physical Curve("top") = {7};
Physical Curve("side") = {8}; Physical Curve("rim") = {9};)";
    folder.write("pin.geo", geo.str());
    toml << R"(mesh.file = "pin.geo"
model.plane = "strain"
materials.steel = { young = 210e3, poisson = 0.3 }
bodies = { "*" = "steel" }
boundary = [
  { on = "ground", displacement = { x = 0, y = 0 } },
  { on = "side", displacement = { x = 0 } },
  { on = "top", pressure = 20 },
]
body_force = [{ body = "pin", force = [0, )"
         << -force / (std::numbers::pi * radius * radius) << R"(] }]
contact = [{ between = ["foot", "track"], initial_gap = "closed" }, { between = ["rim", "track"] }]
)";
    SCOPED_TRACE(toml.str());
    Results r = solve_scene(read_scene(folder.write("pin.toml", toml.str())));
    estimate(r);
    ASSERT_LT(r.estimate->pressure(), 0.3);
    EXPECT_EQ(r.status, Status::check_failed);
    EXPECT_NEAR(r.checks.back().value, r.estimate->pressure_of({1}), 1e-12);
    expect_contains(r.checks.back().where,
                    "of all that presses on body 'pin', the most from the border of contact of 'rim'");
    EXPECT_TRUE(std::ranges::any_of(r.warnings, [](const std::string& line) {
      return line.starts_with("contact.1") && line.find(" % of its own, the most from the border") != std::string::npos;
    }));
    // Where it hardly presses at all it matters to no one: by half of what counts.
    r.recovery.stress.points *= 2e3 * r.recovery.contacts[1].p_max / r.recovery.stress.points.cwiseAbs().maxCoeff();
    EXPECT_TRUE(estimate_check(r)->ok());
    EXPECT_TRUE(
        std::ranges::none_of(error_warnings(r), [](const std::string& line) { return line.starts_with("contact.1"); }));
  }
}

// A block that stands half beside the other, in one curve from end to end.
TEST(LineChecks, CurvesThatAreNotOneAreNamedWithThePlace) {
  const TemporaryFolder folder;
  folder.write("beside.geo", R"(
SetFactory("OpenCASCADE"); Mesh.ElementOrder = 2; Mesh.MeshSizeMax = 0.2;
Rectangle(1) = {0, 0, 0, 4, 1}; Rectangle(2) = {3, 1, 0, 2, 1};
Physical Surface("low") = {1}; Physical Surface("up") = {2};
Physical Curve("ground") = {1}; Physical Curve("track") = {3}; Physical Curve("foot") = {5}; Physical Curve("top") = {7};
)");
  const Results r = solve_scene(read_scene(folder.write("beside.toml", R"(
mesh.file = "beside.geo"
materials.steel = { young = 210e3, poisson = 0.3 }
bodies = { low = "steel", up = "steel" }
boundary = [{ on = "ground", displacement = { x = 0, y = 0 } }, { on = "top", displacement = { x = 0, y = -1e-3 } }]
contact = [{ between = ["foot", "track"], initial_gap = "closed", multipliers_on = "foot" }]
)")));
  EXPECT_EQ(r.status, Status::check_failed);
  const auto check = std::ranges::find(r.checks, std::string("segments cover the closed contact curve"), &Check::name);
  ASSERT_NE(check, r.checks.end());
  EXPECT_NEAR(check->value, 0.5, 0.01);
  expect_contains(check->where, "'foot' faces no part of 'track' on a length of 1 near (4.5, 1)");
}

}  // namespace
}  // namespace mortise::test
