// Bodies that are one where their meshes do not match: patch tests, turns without strain, and every solver.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <random>
#include <set>
#include <sstream>

#include "app/solve_scene.hpp"
#include "support/messages.hpp"
#include "support/two_blocks.hpp"

namespace mortise::test {
namespace {

// A plate of two tied halves and a block below it, whose meshes match nowhere.
const std::string plates = R"(
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Rectangle(1) = {0, 0, 0, 2, 1};
Rectangle(2) = {0, 1, 0, 2, 0.6};
Rectangle(3) = {0, 1.6 + gap, 0, 2, 0.4};
Transfinite Curve{1, 3} = 6; Transfinite Curve{2, 4} = 4;
Transfinite Curve{5, 7} = 9; Transfinite Curve{6, 8} = 3;
Transfinite Curve{9, 11} = 5; Transfinite Curve{10, 12} = 4;
Physical Surface("block") = {1};
Physical Surface("lower") = {2};
Physical Surface("upper") = {3};
Physical Curve("block_bottom") = {1};
Physical Curve("block_top") = {3};
Physical Curve("sides") = {6, 8, 10, 12};
Physical Curve("left") = {4, 8, 12};
Physical Curve("lower_bottom") = {5};
Physical Curve("lower_top") = {7};
Physical Curve("upper_bottom") = {9};
Physical Curve("top") = {11};
)";

Scene scene_of(const TemporaryFolder& folder, const std::string& rest, double gap = 0) {
  folder.write("plates.geo", "gap = " + std::to_string(gap) + ";\n" + plates);
  return read_scene(folder.write("scene.toml",
                                 "mesh.file = \"plates.geo\"\nmaterials.m = { young = 1000, poisson = 0.3 }\n"
                                 "bodies = { block = \"m\", lower = \"m\", upper = \"m\" }\n" +
                                     rest));
}

const std::string tie = R"({ between = ["lower_top", "upper_bottom"], condition = "tied" })";

// Any linear field, shear and tension across the tie among it.
TEST(Ties, PassThePatchTest) {
  const TemporaryFolder folder;
  for (const std::string leads : {"", ", multipliers_on = \"upper_bottom\""}) {
    const std::string with = tie.substr(0, tie.size() - 2) + leads + " }";
    const Results r = solve_scene(scene_of(folder, "contact = [" + with + R"toml(]
boundary = [
  { on = ["sides", "lower_bottom", "top"], displacement = { x = "1e-3 * (x + 2 * y)", y = "1e-3 * (3 * y - x)" } },
  { on = "block_bottom", displacement = { x = 0, y = 0 } },
])toml"));
    EXPECT_EQ(r.status, Status::solved);
    for (Eigen::Index i = 0; i < r.problem.mesh.nodes.rows(); ++i) {
      const Vec2 x = r.problem.mesh.nodes.row(i).transpose();
      if (x.y() < 1 || (x.y() == 1 && r.solution.u(2 * i) == 0)) continue;  // of the block, which nothing loads
      EXPECT_LE((r.solution.u.segment<2>(2 * i) - 1e-3 * Vec2(x.x() + 2 * x.y(), 3 * x.y() - x.x())).norm(), 1e-13);
    }
    ASSERT_EQ(r.recovery.reactions.ties.size(), 1u);
  }
}

TEST(Ties, CarryWhatPressesOnThemByEverySolver) {
  const TemporaryFolder folder;
  const std::string rest = "contact = [" + tie + R"toml(, { between = ["lower_bottom", "block_top"] }]
boundary = [
  { on = "block_bottom", displacement = { x = 0, y = 0 } },
  { on = "left", displacement = { x = 0 } },
  { on = "top", traction = [0.3, "-1 - x"] },
]
method.solver = )toml";
  const Results direct = solve_scene(scene_of(folder, rest + "\"direct\""));
  EXPECT_EQ(direct.status, Status::solved);
  EXPECT_NEAR(
      direct.recovery.reactions.ties[0].force.y() * (direct.problem.mesh.ties[0].curves[0] == "lower_top" ? -1 : 1), 4,
      1e-9);
  EXPECT_EQ(direct.warnings.size(), 0u) << direct.warnings[0];
  for (const std::string solver : {"mssor", "ddm", "feti"}) {
    SCOPED_TRACE(solver);
    const Results other = solve_scene(scene_of(folder, rest + "\"" + solver + "\""));
    EXPECT_EQ(other.status, Status::solved);
    EXPECT_LE(largest_entry(other.recovery.contacts[0].pressure - direct.recovery.contacts[0].pressure),
              1e-7 * largest_entry(direct.recovery.contacts[0].pressure));
  }
}

// A block of two halves, of one material or two, under a plate: what their cut does where it meets the contact line is
// the same whether they share its nodes or are tied.
TEST(Ties, ACutThatMeetsAContactLineIsWhatOneOfSharedNodesIs) {
  std::mt19937 random(31);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  std::set<std::size_t> counts;
  for (int k = 0; k < 10; ++k) {
    std::ostringstream geo;
    geo << "xt = " << draw(0.7, 1.3) << "; xb = " << draw(0.4, 1.6) << "; bend = " << draw(-0.1, 0.1) << ";\n"
        << R"(Mesh.ElementOrder = 2; Mesh.MeshSizeMax = 0.15;
Point(1) = {0, 0, 0}; Point(2) = {xb, 0, 0}; Point(3) = {xt, 1, 0}; Point(4) = {0, 1, 0};
Point(5) = {2, 0, 0}; Point(6) = {2, 1, 0}; Point(10) = {(xb + xt) / 2 + bend, 0.5, 0};
Line(1) = {1, 2}; Spline(2) = {2, 10, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
If (tied)
  Point(7) = {xb, 0, 0}; Point(8) = {xt, 1, 0}; Point(11) = {(xb + xt) / 2 + bend, 0.5, 0}; Spline(8) = {8, 11, 7};
  Line(5) = {7, 5}; Line(7) = {6, 8}; Transfinite Curve{2} = 8; Transfinite Curve{8} = 10;
Else
  Line(5) = {2, 5}; Line(7) = {6, 3}; Transfinite Curve{2} = 8;
EndIf
Line(6) = {5, 6};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
If (tied)
  Curve Loop(2) = {5, 6, 7, 8};
Else
  Curve Loop(2) = {5, 6, 7, -2};
EndIf
Plane Surface(2) = {2};
Point(20) = {0, 1, 0}; Point(21) = {2, 1, 0}; Point(22) = {2, 1.5, 0}; Point(23) = {0, 1.5, 0};
Line(20) = {20, 21}; Line(21) = {21, 22}; Line(22) = {22, 23}; Line(23) = {23, 20};
Curve Loop(3) = {20 : 23}; Plane Surface(3) = {3};
Physical Surface("left") = {1}; Physical Surface("right") = {2}; Physical Surface("plate") = {3};
Physical Curve("bottom") = {1, 5}; Physical Curve("left_top") = {3}; Physical Curve("right_top") = {7};
Physical Curve("plate_bottom") = {20}; Physical Curve("plate_top") = {22};
If (tied)
  Physical Curve("left_cut") = {2}; Physical Curve("right_cut") = {8};
EndIf
)";
    const double stiffness = k % 2 == 0 ? 1000 : 20000;
    const auto solved = [&](bool tied) {
      const TemporaryFolder folder;
      folder.write("block.geo", "tied = " + std::to_string(tied) + ";\n" + geo.str());
      std::ostringstream scene;
      scene << "mesh.file = \"block.geo\"\nmaterials.m = { young = 1000, poisson = 0.3 }\n"
            << "materials.n = { young = " << stiffness << ", poisson = 0.3 }\n"
            << "bodies = { left = \"m\", right = \"n\", plate = \"m\" }\n"
            << R"(boundary = [
  { on = "bottom", displacement = { x = 0, y = 0 } }, { on = "plate_top", displacement = { x = 0, y = -0.01 } },
]
contact = [
  { between = ["left_top", "plate_bottom"] }, { between = ["right_top", "plate_bottom"] },)"
            << (tied ? R"({ between = ["left_cut", "right_cut"], condition = "tied" })" : "") << "]\n";
      Results r = solve_scene(read_scene(folder.write("scene.toml", scene.str())));
      estimate(r);
      return r;
    };
    const Results one = solved(false), two = solved(true);
    for (const std::size_t pair : {0, 1}) {
      const auto &bonded = one.estimate->pressures[pair].singular, &tied = two.estimate->pressures[pair].singular;
      ASSERT_EQ(tied.size(), bonded.size()) << k;
      for (std::size_t i = 0; i < tied.size(); ++i) {
        EXPECT_LE((tied[i].position - bonded[i].position).norm(), 1e-6);
        EXPECT_NEAR(tied[i].exponent, bonded[i].exponent, 1e-6);
        EXPECT_NEAR(tied[i].pressure_exponent, bonded[i].pressure_exponent, 1e-6);
      }
      counts.insert(tied.size());
    }
  }
  EXPECT_EQ(counts, (std::set<std::size_t>{0, 1}));  // of one material none
}

// Without a pair in contact there is no limit to tau, and none is told: it was infinite, which no file can say.
TEST(Ties, AloneGiveAStationaryIterationNoLimit) {
  const TemporaryFolder folder;
  const Results r = solve_scene(scene_of(folder, "contact = [" + tie + R"toml(]
boundary = [
  { on = ["block_bottom", "lower_bottom"], displacement = { x = 0, y = 0 } },
  { on = "top", pressure = 1 },
]
method = { solver = "mssor", acceleration = "none" })toml"));
  EXPECT_EQ(r.status, Status::solved);
  std::vector<std::string> names;
  for (const auto& [name, value] : r.solution.iteration->figures) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"omega", "tau"}));
}

// Two rings whose common circle has different polygons: a turn strains nothing, and forces have no moment left.
// The same plate turned, on an inclined line of symmetry that ends the tie.
TEST(Ties, EndOnSupportsAlongAnyDirection) {
  const auto plate = [](double degrees, const std::string& held) {
    const TemporaryFolder folder;
    const Eigen::Rotation2Dd turn(degrees * std::numbers::pi / 180);
    folder.write("plate.geo",
                 outlines({{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 0}, {2, 0}, {2, 1}, {1, 1}}}, degrees) + R"(
Mesh.ElementOrder = 2;
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5 : 8}; Plane Surface(2) = {2};
Transfinite Curve{1, 3} = 4; Transfinite Curve{2, 4} = 5; Transfinite Curve{5, 7} = 4; Transfinite Curve{6, 8} = 7;
Transfinite Surface{1, 2};
Physical Surface("a") = {1}; Physical Surface("b") = {2};
Physical Curve("bottom") = {1, 5}; Physical Curve("left") = {4}; Physical Curve("right") = {6};
Physical Curve("a_tie") = {2}; Physical Curve("b_tie") = {8};
)");
    const Vec2 n = turn * Vec2::UnitY();
    std::ostringstream across;
    across.precision(17);
    across << n.x() << " * x + " << n.y() << " * y";
    return solve_scene(
        read_scene(folder.write("scene.toml",
                                "mesh.file = \"plate.geo\"\nmaterials.m = { young = 1000, poisson = 0.3 }\n"
                                "bodies = { a = \"m\", b = \"m\" }\n"
                                "contact = [{ between = [\"a_tie\", \"b_tie\"], condition = \"tied\" }]\n"
                                "boundary = [" +
                                    held + ", { on = \"right\", pressure = \"-1 - (" + across.str() + ")^2\" }]\n")));
  };
  const Results straight =
      plate(0, R"({ on = "bottom", displacement = { y = 0 } }, { on = "left", displacement = { x = 0 } })");
  const Results turned =
      plate(40, R"({ on = "bottom", displacement = { normal = 0 } }, { on = "left", displacement = { normal = 0 } })");
  EXPECT_EQ(turned.status, Status::solved);
  EXPECT_NEAR(turned.recovery.energy, straight.recovery.energy, 1e-9 * straight.recovery.energy);
  const Eigen::Rotation2Dd turn(40 * std::numbers::pi / 180);
  for (int i = 0; i < 2; ++i)
    EXPECT_LE((turned.recovery.reactions.entries[i].force - turn * straight.recovery.reactions.entries[i].force).norm(),
              1e-9)
        << i;
  EXPECT_LE((turned.recovery.reactions.ties[0].force - turn * straight.recovery.reactions.ties[0].force).norm(), 1e-9);
}

TEST(Ties, OnACircleTurnWithoutStrain) {
  const TemporaryFolder folder;
  folder.write("rings.geo", R"(
Mesh.ElementOrder = 2;
Point(1) = {0, 0, 0};
For k In {0 : 3}
  r[0] = 1; r[1] = 1.5; r[2] = 1.5; r[3] = 2;
  n[0] = 7; n[1] = 9; n[2] = 6; n[3] = 8;
  For q In {0 : 3}
    Point(10 + 10 * k + q) = {r[k] * Cos(q * Pi / 2), r[k] * Sin(q * Pi / 2), 0};
  EndFor
  For q In {0 : 3}
    Circle(10 + 10 * k + q) = {10 + 10 * k + q, 1, 10 + 10 * k + (q + 1) % 4};
    Transfinite Curve{10 + 10 * k + q} = n[k];
  EndFor
  Curve Loop(1 + k) = {10 + 10 * k : 13 + 10 * k};
EndFor
Plane Surface(1) = {2, 1};
Plane Surface(2) = {4, 3};
Physical Surface("inner") = {1};
Physical Surface("outer") = {2};
Physical Curve("bore") = {10 : 13};
Physical Curve("inner_tie") = {20 : 23};
Physical Curve("outer_tie") = {30 : 33};
Physical Curve("rim") = {40 : 43};
)");
  const auto solved = [&](const std::string& boundary) {
    return solve_scene(
        read_scene(folder.write("scene.toml",
                                "mesh.file = \"rings.geo\"\nmaterials.m = { young = 1000, poisson = 0.3 }\n"
                                "bodies = { inner = \"m\", outer = \"m\" }\n"
                                "contact = [{ between = [\"inner_tie\", \"outer_tie\"], condition = \"tied\" }]\n"
                                "boundary = [" +
                                    boundary + "]\n")));
  };
  const Results turned = solved(R"({ on = "bore", displacement = { x = "-1e-3 * y", y = "1e-3 * x" } })");
  EXPECT_LE(turned.recovery.energy, 1e-15);  // of a strain as large as the turn: 1e-3
  for (Eigen::Index i = 0; i < turned.problem.mesh.nodes.rows(); ++i) {
    const Vec2 x = turned.problem.mesh.nodes.row(i).transpose();
    EXPECT_LE((turned.solution.u.segment<2>(2 * i) - 1e-3 * Vec2(-x.y(), x.x())).norm(), 1e-13);
  }
  // Twisted and squeezed: every check holds, and the squeeze is Lame's.
  const Results squeezed =
      solved(R"({ on = "bore", displacement = { x = "-1e-3 * y", y = "1e-3 * x" } }, { on = "rim", pressure = 1 })");
  EXPECT_EQ(squeezed.status, Status::solved) << squeezed.warnings.size();
}

// A block on a longer one whose edges are shorter, and follow: wherever it ends within an edge.
TEST(Ties, OfABlockOnALongerOneMayEndAnywhere) {
  const TemporaryFolder folder;
  std::mt19937 random(3);
  std::vector<double> moved{0, 1e-4, 1e-3, 0.01, 0.05, 1. / 6, 1. / 3};
  for (int k = 0; k < 10; ++k) moved.push_back(std::uniform_real_distribution<double>(0, 0.5)(random));
  for (const double by : moved)
    for (const char* order : {"Mesh.ElementOrder = 1", "Mesh.ElementOrder = 2"}) {
      folder.write("a.geo", "d = " + std::to_string(by) + "; " + order + R"(; SetFactory("OpenCASCADE");
Rectangle(1) = {-5, 0, 0, 10, 2}; Rectangle(2) = {-3 + d, 2, 0, 6, 2};
Transfinite Curve{1, 3} = 31; Transfinite Curve{2, 4} = 7; Transfinite Curve{5, 7} = 9; Transfinite Curve{6, 8} = 4;
Transfinite Surface{1, 2}; Recombine Surface{1, 2};
Physical Surface("low") = {1}; Physical Surface("up") = {2};
Physical Curve("ground") = {1}; Physical Curve("top") = {3}; Physical Curve("foot") = {5}; Physical Curve("head") = {7};
)");
      std::vector<double> energy;
      for (const char* follows : {"top", "foot"}) {
        const Results r = solve_scene(read_scene(folder.write("a.toml", R"(mesh.file = "a.geo"
materials.m = { young = 1000, poisson = 0.3 }
bodies = { low = "m", up = "m" }
boundary = [{ on = "ground", displacement = { x = 0, y = 0 } }, { on = "head", traction = [0.3, -1] }]
contact = [{ between = ["top", "foot"], condition = "tied", multipliers_on = ")" +
                                                                            std::string(follows) + "\" }]\n")));
        EXPECT_EQ(r.status, Status::solved);
        energy.push_back(r.recovery.energy);
      }
      EXPECT_NEAR(energy[0], energy[1], 0.025 * energy[1]) << by << order;
    }
}

// A multiplier of rings has no weight at the end of a quadratic edge on the axis: round-off said whether that was tied.
TEST(Ties, HoldOnTheAxis) {
  const TemporaryFolder folder;
  for (const double unit : {1., 0.1, 3., 25.4})
    for (const auto& [lower, upper] : {std::pair(7, 9), std::pair(16, 5), std::pair(3, 30)}) {
      std::ostringstream geo;
      geo << std::setprecision(17) << "L = " << unit << "; Mesh.ElementOrder = 2; SetFactory(\"OpenCASCADE\");\n"
          << "Rectangle(1) = {0, 0, 0, 2*L, L}; Rectangle(2) = {0, L, 0, 2*L, L};\nTransfinite Curve{1, 3} = "
          << lower + 1 << "; Transfinite Curve{5, 7} = " << upper + 1 << R"(;
Transfinite Curve{2, 4, 6, 8} = 4; Transfinite Surface{1, 2}; Recombine Surface{1, 2};
Physical Surface("low") = {1}; Physical Surface("up") = {2};
Physical Curve("ground") = {1}; Physical Curve("top") = {3}; Physical Curve("foot") = {5}; Physical Curve("head") = {7};
)";
      folder.write("a.geo", geo.str());
      const Results r = solve_scene(read_scene(folder.write("a.toml", R"(mesh.file = "a.geo"
model.plane = "axisymmetric"
materials = { m = { young = 1000, poisson = 0.3 }, k = { young = 300, poisson = 0.4 } }
bodies = { low = "m", up = "k" }
boundary = [{ on = "ground", displacement = { y = 0 } }, { on = "head", pressure = 1 }]
contact = [{ between = ["top", "foot"], condition = "tied" }]
)")));
      const Points& nodes = r.problem.mesh.nodes;
      std::vector<double> along;
      for (Eigen::Index i = 0; i < nodes.rows(); ++i)
        if (nodes(i, 0) == 0 && std::abs(nodes(i, 1) - unit) < 1e-9 * unit) along.push_back(r.solution.u(2 * i + 1));
      ASSERT_EQ(along.size(), 2u);
      EXPECT_NEAR(along[0], along[1], 1e-12 * unit) << unit << " " << lower << " " << upper;
    }
}

TEST(Ties, RefuseWhatCannotBeTied) {
  const TemporaryFolder folder;
  const std::string held =
      "boundary = [{ on = [\"left\", \"block_bottom\", \"top\"], displacement = { x = 0, y = 0 } }]\n";
  expect_contains(message_of([&] { solve_scene(scene_of(folder, "contact = [" + tie + "]\n" + held, 0.1)); }),
                  "expected tied curves that coincide");
  expect_contains(message_of([&] {
                    scene_of(folder, "contact = [" + tie.substr(0, tie.size() - 2) + ", clearance = 1 }]\n" + held);
                  }),
                  "has no meaning with condition = \"tied\"");
  expect_contains(message_of([&] {
                    solve_scene(scene_of(
                        folder, "contact = [" + tie + ", { between = [\"upper_bottom\", \"lower_top\"] }]\n" + held));
                  }),
                  "twice");
}

}  // namespace
}  // namespace mortise::test
