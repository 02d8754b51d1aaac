// Supports along any direction, rigid curves, and points, against the same problem in other axes and exact solutions.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <sstream>

#include "app/solve_scene.hpp"
#include "support/messages.hpp"
#include "support/two_blocks.hpp"

namespace mortise::test {
namespace {

// Two blocks 0 <= x <= 2, the lower one from y = 0 to 1, the upper one to 1.6, turned about the origin, on meshes that
// do not match.
std::string blocks(double degrees) {
  return outlines({{{0, 0}, {2, 0}, {2, 1}, {0, 1}, {0, 1}, {2, 1}, {2, 1.6}, {0, 1.6}}}, degrees) + R"(
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5 : 8}; Plane Surface(2) = {2};
Transfinite Surface{1, 2};
Physical Point("corner") = {1};
Physical Point("feet") = {1, 2};
Physical Point("top_right") = {7};
)" + unlike_blocks;
}

Scene supported_scene(const TemporaryFolder& folder, const std::string& rest, double degrees = 0,
                      double poisson = 0.3) {
  folder.write("blocks.geo", blocks(degrees));
  return read_scene(folder.write(
      "scene.toml", "mesh.file = \"blocks.geo\"\nmodel.plane = \"stress\"\nmaterials.m = { young = 1000, poisson = " +
                        std::to_string(poisson) + " }\nbodies = { lower = \"m\", upper = \"m\" }\n" + rest));
}

const std::string contact = "contact = [{ between = [\"upper_contact\", \"lower_contact\"] }]\n";

// A punch pressed down in a part of the top, beside a symmetry line.
TEST(Supports, TurnedAxesChangeNothing) {
  const TemporaryFolder straight_folder, turned_folder;
  const Results straight = solve_scene(supported_scene(straight_folder, contact + R"toml(
boundary = [
  { on = ["lower_left", "upper_left"], displacement = { x = 0 } },
  { on = "bottom", displacement = { y = 2e-3 } },
  { on = "top", pressure = "1 + x^3" },
])toml"));
  ASSERT_EQ(straight.status, Status::solved);
  for (const std::string method : {"direct", "mssor", "ddm", "feti"}) {
    SCOPED_TRACE(method);
    const Results turned = solve_scene(supported_scene(turned_folder, contact + "method.solver = \"" + method + R"toml("
boundary = [
  { on = ["lower_left", "upper_left"], displacement = { normal = 0 } },
  { on = "bottom", displacement = { direction = [-1, 1.7320508075688772], value = 2e-3 } },
  { on = "top", pressure = "1 + (x * cos(30 * pi / 180) + y * sin(30 * pi / 180))^3" },
])toml",
                                                       30));
    EXPECT_EQ(turned.status, Status::solved);
    const VecX &p = turned.recovery.contacts[0].pressure, &q = straight.recovery.contacts[0].pressure;
    ASSERT_EQ(p.size(), q.size());
    EXPECT_LE(largest_entry(p - q), 1e-7 * largest_entry(q));
    EXPECT_NEAR(turned.recovery.energy, straight.recovery.energy, 1e-7 * straight.recovery.energy);
    const Eigen::Rotation2Dd turn(std::numbers::pi / 6);
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec2 force = turn * straight.recovery.reactions.entries[i].force;
      EXPECT_LE((turned.recovery.reactions.entries[i].force - force).norm(), 1e-7) << i;
    }
  }
}

TEST(Supports, TheEstimateOfTurnedAxesIsTheSame) {
  const TemporaryFolder straight_folder, turned_folder;
  const auto estimated = [](const Scene& scene) {
    Results r = solve_scene(scene);
    estimate(r, {});
    return r;
  };
  const Results straight = estimated(supported_scene(straight_folder, contact + R"toml(
boundary = [{ on = "bottom", displacement = { x = 0, y = 0 } }, { on = "upper_left", displacement = { x = 0 } },
            { on = "top", pressure = "1 + s" }])toml")),
                turned = estimated(supported_scene(turned_folder, contact + R"toml(
boundary = [{ on = "bottom", displacement = { x = 0, y = 0 } }, { on = "upper_left", displacement = { normal = 0 } },
            { on = "top", pressure = "1 + s" }])toml",
                                                   50));
  EXPECT_NEAR(turned.estimate->pressure(), straight.estimate->pressure(), 1e-6 * straight.estimate->pressure());
}

// sigma_22 = a + b (x - 1) without lateral contraction: u_y = (a + b (x - 1)) y / E, u_x = (c - b y^2 / 2) / E.
TEST(Supports, ARigidTopTakesForceAndMoment) {
  const TemporaryFolder folder;
  const std::string held = "boundary = [{ on = \"bottom\", displacement = { x = 0, y = 0 } }, { on = \"top\", rigid = ";
  const double force = -6, moment = 0.4, height = 1.6, E = 1000, a = force / 2, b = moment / (2.0 / 3);
  const Results loaded =
      solve_scene(supported_scene(folder, contact + held + "{ x = 0, force = [0, -6], moment = 0.4 } }]", 0, 0));
  EXPECT_EQ(loaded.status, Status::solved);
  ASSERT_EQ(loaded.recovery.reactions.rigid_motions.size(), 1u);
  const Eigen::Vector3d motion = loaded.recovery.reactions.rigid_motions[0];
  EXPECT_NEAR(motion(0), 0, 1e-15);
  EXPECT_NEAR(motion(1), a * height / E, 1e-12);
  EXPECT_NEAR(motion(2), b * height / E, 1e-12);
  EXPECT_LE(loaded.recovery.reactions.entries[1].force.norm(), 1e-9);

  // What was found is prescribed, about another point: the same reactions.
  const Vec2 at_corner = motion.head<2>() + motion(2) * Vec2(0, 1);
  std::ostringstream given;
  given.precision(17);
  given << "{ x = " << at_corner.x() << ", y = " << at_corner.y() << ", rotation = " << motion(2)
        << ", about = [2, 1.6] } }]";
  const Results moved = solve_scene(supported_scene(folder, contact + held + given.str(), 0, 0));
  EXPECT_EQ(moved.status, Status::solved);
  EXPECT_NEAR(moved.recovery.reactions.entries[1].force.x(), 0, 1e-9);
  EXPECT_NEAR(moved.recovery.reactions.entries[1].force.y(), force, 1e-9);
  EXPECT_NEAR(moved.recovery.reactions.entries[1].moment_about({1, height}), moment, 1e-9);
}

// The line of symmetry holds a node of the rigid top, which moves along it.
TEST(Supports, ARigidTopMayEndOnALineOfSymmetry) {
  const TemporaryFolder folder;
  const Results r = solve_scene(supported_scene(folder, contact + R"toml(
boundary = [
  { on = "bottom", displacement = { y = 0 } },
  { on = ["lower_left", "upper_left"], displacement = { x = 0 } },
  { on = "top", rigid = { x = 0, y = -1.6e-3, rotation = 0 } },
])toml",
                                                0, 0));
  EXPECT_EQ(r.status, Status::solved);
  EXPECT_NEAR(r.recovery.reactions.entries[2].force.y(), -2, 1e-9);
  for (const double p : r.recovery.contacts[0].pressure) EXPECT_NEAR(p, 1, 1e-9);
}

// A wheel whose head is held along x may only turn about it, which rolls its foot along the rail; contact resists that
// by its pressures. Where that was held by an unknown, as a free roller's is, this carried 0.15 % of the load.
TEST(Supports, ContactCarriesAllOfAWheelWhoseHeadIsHeld) {
  const TemporaryFolder folder;
  folder.write("wheel.geo",
               R"(Mesh.ElementOrder = 2; Mesh.CharacteristicLengthMin = 1.5; Mesh.CharacteristicLengthMax = 1.5;
y = 600 - Sqrt(600 * 600 - 100);
Point(1) = {-40, -40, 0}; Point(2) = {40, -40, 0}; Point(3) = {40, 0, 0}; Point(4) = {-40, 0, 0};
Point(5) = {-10, y, 0}; Point(6) = {10, y, 0}; Point(7) = {0, 600, 0}; Point(8) = {40, 40, 0}; Point(9) = {-40, 40, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Circle(5) = {5, 7, 6}; Line(6) = {6, 8}; Line(7) = {8, 9}; Line(8) = {9, 5};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1}; Curve Loop(2) = {5 : 8}; Plane Surface(2) = {2};
Physical Surface("rail") = {1}; Physical Surface("wheel") = {2};
Physical Curve("ground") = {1}; Physical Curve("top") = {3}; Physical Curve("foot") = {5}; Physical Curve("head") = {7};
)");
  for (const std::string side : {"foot", "top"}) {
    const Results r = solve_scene(read_scene(folder.write("wheel.toml", R"(mesh.file = "wheel.geo"
materials.steel = { young = 210e3, poisson = 0.3 }
bodies = { rail = "steel", wheel = "steel" }
boundary = [{ on = "ground", displacement = { x = 0, y = 0 } }, { on = "head", displacement = { x = 0 } },
            { on = "head", pressure = 12.5 }]
contact = [{ between = ["foot", "top"], multipliers_on = ")" + side + "\" }]\n")));
    EXPECT_NEAR(std::abs(r.recovery.contacts[0].force.y()), 1000, 1e-6) << side;
    for (const std::string& line : r.warnings) EXPECT_EQ(line.find("nothing holds"), std::string::npos) << line;
  }
}

TEST(Supports, PointsHoldLoadAndSpring) {
  const TemporaryFolder folder;
  const Results r = solve_scene(supported_scene(folder, contact + R"toml(
boundary = [
  { on = "corner", displacement = { x = 0 } },
  { on = "upper_left", displacement = { x = 0 } },
  { on = "feet", spring = [0, 50] },
  { on = "top", force = [0, -1] },
  { on = "top_right", force = [0, -0.5] },
])toml"));
  EXPECT_EQ(r.status, Status::solved);
  double pushed = 0;
  for (const NamedPoint& point : r.problem.mesh.points)
    if (point.name == "feet")
      for (const int node : point.nodes) pushed -= 50 * r.solution.u(2 * node + 1);
  EXPECT_NEAR(pushed, 1.5, 1e-9);
  EXPECT_NEAR(r.recovery.reactions.entries[2].force.y(), 1.5, 1e-9);
  // The corner is held, but nothing pushes against it.
  std::vector<std::string> forces;
  for (const std::string& line : r.warnings)
    if (const auto end = line.find(": stresses and the displacement there"); end != std::string::npos)
      forces.push_back(line.substr(0, end));
  EXPECT_EQ(forces, (std::vector<std::string>{"boundary.2 (line 10): a force of 1.5 at the point 'feet'",
                                              "boundary.4 (line 12): a force of 0.5 at the point 'top_right'"}));
}

// A body that grows freely pushes on nothing; held on both sides it does push.
TEST(Supports, PointsThatHoldAgainstNothingAreNotLoaded) {
  const TemporaryFolder folder;
  folder.write("bar.geo", R"(
SetFactory("OpenCASCADE"); Mesh.ElementOrder = 2;
Rectangle(1) = {1, 0, 0, 2, 4};
Physical Surface("bar") = {1}; Physical Curve("bottom") = {1}; Physical Point("corner") = {1}; Physical Point("tip") = {3};
)");
  const auto told = [&](const std::string& more) {
    const Results r = solve_scene(read_scene(folder.write("bar.toml", R"(
mesh.file = "bar.geo"
materials.m = { young = 1000, poisson = 0.25, thermal_expansion = 1e-4 }
bodies = { bar = "m" }
initial_strain = [{ body = "bar", temperature_change = 100 }]
boundary = [{ on = "bottom", displacement = { y = 0 } }, { on = "corner", displacement = { x = 0 } })" +
                                                                          more + "]")));
    return std::ranges::count_if(
        r.warnings, [](const std::string& line) { return line.find("at the point") != std::string::npos; });
  };
  EXPECT_EQ(told(""), 0);
  EXPECT_EQ(told(R"(, { on = "tip", displacement = { x = 0 } })"), 2);
}

// The node of the corner is held twice, and what holds it is each support's own.
TEST(Supports, TwoThatMeetReactAlongTheirOwnNormals) {
  const TemporaryFolder folder;
  const Results r = solve_scene(supported_scene(folder, contact + R"toml(
boundary = [
  { on = ["lower_left", "upper_left"], displacement = { normal = 0 } },
  { on = "bottom", displacement = { normal = 0 } },
  { on = "top", pressure = 1 }, { on = ["lower_right", "upper_right"], pressure = 0.25 },
])toml",
                                                30));
  ASSERT_EQ(r.status, Status::solved);
  const Eigen::Rotation2Dd turn(std::numbers::pi / 6);
  const Vec2 left = r.recovery.reactions.entries[0].force, bottom = r.recovery.reactions.entries[1].force;
  EXPECT_GT(left.norm(), 0.1);
  EXPECT_NEAR(left.dot(turn * Vec2::UnitY()), 0, 1e-9 * left.norm());
  EXPECT_NEAR(bottom.dot(turn * Vec2::UnitX()), 0, 1e-9 * bottom.norm());
  EXPECT_LE(r.recovery.reactions.held.force.norm(), 1e-9 * left.norm());  // nothing is left of either
}

// "feet" is on the first node of the bottom and on its last, the corner on two curves of one support.
TEST(Supports, TheReactionOfANodeThatTwoCurvesShareCountsOnce) {
  const TemporaryFolder folder;
  const Results r = solve_scene(supported_scene(folder, contact + R"toml(
boundary = [
  { on = ["bottom", "lower_left"], displacement = { direction = [1, 3], value = 0 } },
  { on = "feet", displacement = { direction = [3, -1], value = 0 } },
  { on = "upper_left", displacement = { x = 0 } },
  { on = "top", pressure = 1 },
])toml"));
  Vec2 sum = r.recovery.reactions.loads.force;
  for (const Resultant& entry : r.recovery.reactions.entries) sum += entry.force;
  EXPECT_NEAR(r.recovery.reactions.loads.force.y(), -2, 1e-12);
  EXPECT_GT(std::abs(r.recovery.reactions.entries[1].force.x()), 0.1);
  EXPECT_LE(sum.norm(), 1e-9);
}

// One support on three sides of a rectangle holds its corners both ways: u = (0.3 x, -y) / E under a pressure of 1.
TEST(Supports, NormalsAtACornerAreThoseOfBothSides) {
  const TemporaryFolder folder;
  const Results r = solve_scene(supported_scene(folder, contact + R"toml(
boundary = [
  { on = ["bottom", "lower_left", "upper_left"], displacement = { normal = 0 } },
  { on = "top", pressure = 1 },
])toml"));
  for (Eigen::Index i = 0; i < r.problem.mesh.nodes.rows(); ++i) {
    const Vec2 x = r.problem.mesh.nodes.row(i).transpose();
    EXPECT_LE((r.solution.u.segment<2>(2 * i) - Vec2(0.3e-3 * x.x(), -1e-3 * x.y())).norm(), 1e-12) << x.transpose();
  }
}

// A displacement along -x by v is one along x by -v.
TEST(Supports, AValueAlongAnAxisBackwardsIsItsOpposite) {
  const TemporaryFolder folder;
  const auto moved = [&](const std::string& right, const std::string& top) {
    return solve_scene(supported_scene(folder, contact +
                                                   "boundary = [{ on = \"bottom\", displacement = { y = 0 } }, "
                                                   "{ on = [\"lower_left\", \"upper_left\"], displacement = { x = 0 } "
                                                   "}, { on = \"lower_right\", displacement = { " +
                                                   right + " } }, { on = \"top\", displacement = { " + top + " } }]"));
  };
  const VecX u = moved("x = 0.02", "y = -0.01").solution.u;
  for (const char* right : {"direction = [-1, 0], value = -0.02", "direction = [2, 0], value = 0.02", "normal = 0.02"})
    for (const char* top : {"direction = [0, -3], value = 0.01", "direction = [0, 1], value = -0.01"})
      EXPECT_LT((moved(right, top).solution.u - u).norm(), 1e-12 * u.norm()) << right << ", " << top;
}

TEST(Supports, AForceOnTwoPointsIsTheirSum) {
  const TemporaryFolder folder;
  const Results r = solve_scene(supported_scene(folder, contact + R"toml(
boundary = [
  { on = ["lower_contact"], displacement = { y = 0 } },
  { on = ["lower_left", "upper_left"], displacement = { x = 0 } },
  { on = "feet", force = [0, -2] },
  { on = "top", pressure = 1 },
])toml"));
  EXPECT_NEAR(r.recovery.reactions.loads.force.y(), -4, 1e-12);
  EXPECT_NEAR(r.recovery.reactions.all.force.y(), 4, 1e-9);
}

// Two entries that hold a node along one line, either way, must agree.
TEST(Supports, TwoEntriesAlongOneLineThatDisagreeAreRefused) {
  const TemporaryFolder folder;
  const auto with = [&](const std::string& corner) {
    const Scene scene = supported_scene(
        folder,
        contact +
            "boundary = [{ on = \"lower_left\", displacement = { direction = "
            "[1, 1], value = 1e-3 } }, { on = \"bottom\", displacement = { direction = [1, -1], value = 0 } }, "
            "{ on = \"upper_left\", displacement = { x = 0 } }, { on = \"top\", pressure = 1 }, { on = \"top_right\", "
            "displacement = { direction = [1, 2], value = 0 } }, { on = \"upper_right\", displacement = { " +
            corner + " } }]");
    return message_of([&] { solve_scene(scene); });
  };
  EXPECT_NE(with("direction = [1, 2], value = 1e-6").find("expected one value a node"), std::string::npos);
  EXPECT_NE(with("direction = [-1, -2], value = 1e-6").find("expected one value a node"), std::string::npos);
  EXPECT_EQ(with("direction = [-1, -2], value = 0"), "(nothing was thrown)");
}

TEST(Supports, RefusesWhatCannotBeMeant) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& entry) {
    const Scene scene = supported_scene(
        folder, contact + "boundary = [{ on = \"bottom\", displacement = { x = 0, y = 0 } }, " + entry + "]");
    return message_of([&] { solve_scene(scene); });
  };
  const auto expect = [&](const std::string& entry, const std::string& words) {
    EXPECT_NE(refused(entry).find(words), std::string::npos) << entry << "\n" << refused(entry);
  };
  expect(R"({ on = "corner", pressure = 1 })", "'corner' is a point");
  expect(R"({ on = "corner", foundation = 1 })", "expected a curve, or 'spring' at a point");
  expect(R"({ on = "top", spring = 1 })", "'top' is a curve");
  expect(R"({ on = ["top", "top_right"], force = [0, 1] })", "acts on curves and on points");
  expect(R"({ on = "bottom", rigid = { } })", "whose displacement x another entry prescribes as 0");
  expect(R"({ on = "bottom", rigid = { x = 0, y = 0, rotation = 0.1 } })", "expected rigid = { y, rotation }");
  expect(R"({ on = "corner", displacement = { direction = [1, 1], value = 1 } })", "expected one value a node");
  expect(R"({ on = "nowhere", displacement = { normal = 0 } })", "unknown boundary 'nowhere'");
}

}  // namespace
}  // namespace mortise::test
