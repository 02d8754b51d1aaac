// Motions that nothing holds: the pressure does not depend on them unless a load drives them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>

#include "app/accuracy.hpp"
#include "app/solve_scene.hpp"
#include "support/differences.hpp"
#include "support/messages.hpp"
#include "support/plate_scenes.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// The upper plate is pressed on by 10 MPa and held by nothing but contact.
Scene pressed_on() {
  Scene scene = uniaxial_scene();
  scene.boundaries[0].on = {"lower_left"};
  return scene;
}

int held_notes(const Results& r) {
  int count = 0;
  for (const std::string& note : r.warnings) count += note.find("nothing holds body 'upper'") != std::string::npos;
  return count;
}

TEST(FreeMotions, APlateThatMaySlideIsHeldByEveryMethodAndThePressureIsExact) {
  for (const Solver solver : {Solver::direct, Solver::ddm, Solver::mssor, Solver::feti}) {
    SCOPED_TRACE(to_string(solver));
    Scene scene = pressed_on();
    scene.method.solver = solver;
    const Results r = solve_scene(scene, mesh_of({}));
    EXPECT_EQ(r.status, Status::solved);
    EXPECT_EQ(held_notes(r), 1);
    const VecX& p = r.recovery.contacts[0].pressure;
    EXPECT_LE(largest_entry(p - VecX::Constant(p.size(), 10e6)), 1e-7 * 10e6);
  }
}

// A line that is an arc of radius 0.5 about (0.4, -0.1); its vertices are even in x, so unevenly spaced on the arc.
TwoPlates saddle(int n, CellKind kind) {
  TwoPlates plates;
  plates.height = [](double x) { return std::sqrt(0.25 - (x - 0.4) * (x - 0.4)) - 0.1; };
  plates.n_upper = n;
  plates.n_lower = n * 5 / 4;
  plates.kind_upper = plates.kind_lower = kind;
  return plates;
}

TEST(FreeMotions, ASaddleOnARoundTopMayTurnWhateverItsChordsSay) {
  for (const CellKind kind : {CellKind::tri3, CellKind::quad4, CellKind::tri6, CellKind::quad8}) {
    const double reference = largest_entry(solve_scene(pressed_on(), mesh_of(saddle(32, CellKind::quad8))).solution.u);
    for (const int n : {8, 12, 16, 24}) {
      SCOPED_TRACE(std::to_string(int(kind)) + ", " + std::to_string(n));
      const Results r = solve_scene(pressed_on(), mesh_of(saddle(n, kind)));
      EXPECT_NE(r.status, Status::not_converged);
      EXPECT_EQ(held_notes(r), 1);
      EXPECT_LE(largest_entry(r.solution.u), 2 * reference);
      EXPECT_NEAR(std::abs(r.recovery.contacts[0].force.y()), 10e6 * 0.8,
                  1e-6 * 10e6);  // balances the load, on whichever side
    }
  }
}

TEST(FreeMotions, AMotionThatTheLoadDrivesIsAnError) {
  for (const bool round : {false, true}) {
    Scene scene = pressed_on();
    BoundarySpec across;
    across.key = "boundary";
    across.on = {"upper_left"};
    across.what = SurfaceTraction{Vec2(1e5, 0)};
    scene.boundaries.push_back(across);
    const TwoPlates plates = round ? saddle(12, CellKind::quad4) : TwoPlates{};
    expect_contains(message_of([&] { solve_scene(scene, mesh_of(plates)); }), "nothing holds body 'upper'");
  }
}

// A shaft of radius 10, `aside` of the middle of its bore, which is 0.05 wider and `soft` times as soft; a load of 1
// per area pulls it along `angle`.
Results shaft_in_a_bore(const Vec2& aside, double angle, double soft, const std::string& multipliers_on) {
  const TemporaryFolder folder;
  std::ostringstream geo, scene;
  geo << "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {-30, -30, 0, 60, 60}; Disk(2) = {0, 0, 0, 10.05};\n"
      << "BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };\n"
      << "Disk(4) = {" << aside.x() << ", " << aside.y() << ", 0, 10};\n"
      << R"(
Physical Surface("house") = {3}; Physical Surface("shaft") = {4};
rim() = Boundary{ Surface{4}; }; Physical Curve("rim") = rim();
all() = Boundary{ Surface{3}; }; bore() = Curve In BoundingBox{-11, -11, -1, 11, 11, 1}; bore() -= rim(); all() -= bore();
Physical Curve("bore") = bore(); Physical Curve("out") = all();
MeshSize{ : } = 5; MeshSize{ PointsOf{ Curve{rim(), bore()}; } } = 1; Mesh.ElementOrder = 2;)";
  folder.write("shaft.geo", geo.str());
  scene << "mesh.file = \"shaft.geo\"\nmaterials.steel = { young = 210e3, poisson = 0.3 }\n"
        << "materials.soft = { young = " << 210e3 / soft << ", poisson = 0.3 }\n"
        << "bodies = { shaft = \"steel\", house = \"soft\" }\n"
        << "boundary = [{ on = \"out\", displacement = { x = 0, y = 0 } }]\n"
        << "body_force = [{ body = \"shaft\", force = [" << std::cos(angle) << ", " << std::sin(angle) << "] }]\n"
        << "[[contact]]\nbetween = [\"rim\", \"bore\"]\n";
  if (!multipliers_on.empty()) scene << "multipliers_on = \"" << multipliers_on << "\"\n";
  return solve_scene(read_scene(folder.write("shaft.toml", scene.str())));
}

// Along the normals of the bore the shaft's turn about its own centre opens a gap, and with it a shift that opens none.
// What holds the turn has the moment of the load on how far the shaft is aside, and no force.
TEST(FreeMotions, AShaftThatIsDrawnAsideInItsBoreIsHeldWhosesoeverNormalsCount) {
  std::mt19937 random(41);
  std::uniform_real_distribution<double> far(0.05, 1), turn(0, 2 * std::numbers::pi);
  for (int i = 0; i < 6; ++i) {
    const double distance = 0.05 * far(random), at = turn(random), angle = turn(random);
    const Vec2 aside = distance * Vec2(std::cos(at), std::sin(at));
    for (const auto& [soft, on] : {std::pair{1.0, "rim"}, {1.0, "bore"}, {100.0, ""}}) {
      SCOPED_TRACE(std::to_string(i) + ", " + on);
      const Results r = shaft_in_a_bore(aside, angle, soft, on);
      EXPECT_NE(r.status, Status::not_converged);
      Vec2 force = r.recovery.contacts[0].force;
      if (r.problem.pairs[0].spec.multipliers_on == "rim") force = -force;
      const Vec2 load = r.recovery.reactions.loads.force;
      EXPECT_NEAR(load.norm(), 100 * std::numbers::pi, 0.1);
      EXPECT_LE((force - load).norm(), 1e-9 * load.norm());
      EXPECT_LE(r.recovery.reactions.held.force.norm(), 1e-9 * load.norm());
      for (const auto& motions : least_motions(r.problem.mesh, r.problem.held.motions, r.solution.u))
        for (const RigidMotion& spin : motions)  // of a shaft of radius 1: none is left
          EXPECT_LE(std::hypot(spin.translation.norm(), spin.rotation), 1e-6 * largest_entry(r.solution.u));
    }
  }
}

// A body of two blocks that are apart, of quadrilaterals of one size or of many, drawn at random: no factor tells round
// off that the second is free, and no load need drive it.
TEST(FreeMotions, APieceOfABodyThatNothingHoldsIsNamed) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> size(0.3, 2), far(3, 6);
  const TemporaryFolder folder;
  for (int i = 0; i < 20; ++i) {
    const double x = far(random), a = size(random), b = size(random);
    std::ostringstream geo;
    geo << "Mesh.ElementOrder = " << 1 + i % 2 << "; Mesh.RecombineAll = " << i / 2 % 2
        << ";\nSetFactory(\"OpenCASCADE\");\n"
        << "Rectangle(1) = {0, 0, 0, 2, 1}; Rectangle(2) = {" << x << ", 3, 0, " << a << ", " << b << "};\n"
        << "Physical Surface(\"body\") = {1, 2}; Physical Curve(\"ground\") = {1}; Physical Curve(\"top\") = {7};\n"
        << "Physical Curve(\"side\") = {8};\nMeshSize{:} = " << std::max(a, b) / (1 + i % 3) << ";\n";
    folder.write("pieces.geo", geo.str());
    const auto said = [&](const std::string& more) {
      return message_of<InputError>([&] {
        solve_scene(read_scene(folder.write("pieces.toml",
                                            "mesh.file = \"pieces.geo\"\nmaterials.m = { young = 1, poisson = 0.3 }\n"
                                            "bodies.body = \"m\"\n[[boundary]]\non = \"ground\"\n"
                                            "displacement = { x = 0, y = 0 }\n" +
                                                more)));
      });
    };
    const std::string loaded = "[[boundary]]\non = \"top\"\npressure = 1\n",
                      on_rollers = "[[boundary]]\non = \"side\"\ndisplacement = { x = 0 }\n";
    for (const std::string& more : {std::string(), loaded, on_rollers, on_rollers + loaded})
      expect_contains(said(more), "body 'body' is 2 pieces, of which nothing but contact can hold that near (");
    EXPECT_EQ(said("[[boundary]]\non = \"side\"\ndisplacement = { x = 0, y = 0 }\n" + loaded), "(nothing was thrown)");
  }
}

TEST(FreeMotions, WhatAnOvalLineHoldsIsHeld) {
  TwoPlates plates = saddle(12, CellKind::quad8);
  plates.height = [](double x) { return 1.02 * std::sqrt(0.25 - (x - 0.4) * (x - 0.4)) - 0.1; };
  EXPECT_EQ(held_notes(solve_scene(pressed_on(), mesh_of(plates))), 0);
}

// A pin in a V-block that gives way by 1 under it: flats at an angle to the horizontal, on edges of the pin's radius
// over `edges` (drawn along a circle that starts anywhere) or as an accuracy asks for.
struct PinInVBlock {
  double radius, angle, start;  // length, radians
  Vec2 centre;
  int edges, order;
  bool accurate;
};

Results solved(const PinInVBlock& v) {
  const TemporaryFolder folder;
  const double R = v.radius, s = std::sin(v.angle), c = std::cos(v.angle), weight = std::numbers::pi * R * R;
  std::ostringstream geo, scene;
  geo << "SetFactory(\"OpenCASCADE\"); R = " << R << "; x = " << v.centre.x() << "; y = " << v.centre.y() << ";\n"
      << "s = " << s << "; c = " << c << "; t = y - 1.001 * R / c;\n"  // of the V: the flats are R / 1000 away
      << "Point(1) = {x, t, 0}; Point(2) = {x + 2 * R * c, t + 2 * R * s, 0}; Point(3) = {x + 2 * R * c, t - R, 0};\n"
      << "Point(4) = {x - 2 * R * c, t - R, 0}; Point(5) = {x - 2 * R * c, t + 2 * R * s, 0};\n"
      << "For k In {1 : 5}\nLine(k) = {k, k % 5 + 1};\nEndFor\n"
      << "Curve Loop(1) = {1 : 5}; Plane Surface(1) = {1}; Circle(6) = {x, y, 0, R, " << v.start << ", " << v.start
      << " + 2 * Pi}; Curve Loop(2) = {6}; Plane Surface(2) = {2};\n"
      << "Physical Surface(\"block\") = {1}; Physical Surface(\"pin\") = {2}; Physical Curve(\"flats\") = {1, 5};\n"
      << "Physical Curve(\"base\") = {3}; Physical Curve(\"sides\") = {2, 4}; Physical Curve(\"rim\") = {6};\n"
      << "MeshSize{ : } = R / " << v.edges << "; Mesh.ElementOrder = " << v.order << ";\n";
  folder.write("v.geo", geo.str());
  scene << "mesh.file = \"v.geo\"\nmaterials.steel = { young = 1e6, poisson = 0.3 }\n"
        << "bodies = { block = \"steel\", pin = \"steel\" }\ncontact = [{ between = [\"flats\", \"rim\"], "
           "multipliers_on = \"rim\" }]\n"
        << "boundary = [{ on = \"base\", foundation = " << weight / (4 * R * c) << " }, "
        << "{ on = \"sides\", displacement = { x = 0 } }]\nbody_force = [{ body = \"pin\", force = [0, -1] }]\n";
  if (!v.accurate) return solve_scene(read_scene(folder.write("v.toml", scene.str())));
  scene << "accuracy.value = 0.03\n";
  return *solve_to_accuracy(read_scene(folder.write("v.toml", scene.str())));
}

// Of the body's nodes about their centre: radians.
double turn_of(const Results& r, const std::string& body) {
  const Problem& p = r.problem;
  const auto b = std::ranges::find(p.mesh.bodies, body) - p.mesh.bodies.begin();
  const std::vector<int> nodes(p.points.node.begin() + p.points.first[b],
                               p.points.node.begin() + p.points.first[b + 1]);
  const Points x = p.mesh.nodes(nodes, Eigen::all);
  const Points arms = x.rowwise() - x.colwise().mean();
  double turned = 0;
  for (Eigen::Index i = 0; i < arms.rows(); ++i)
    turned += arms(i, 0) * r.solution.u(2 * nodes[i] + 1) - arms(i, 1) * r.solution.u(2 * nodes[i]);
  return turned / arms.squaredNorm();
}

// That the spin of a pin is free says nothing of it: none is an answer as good as any, and says so on every mesh.
TEST(FreeMotions, APinThatSinksDoesNotSpin) {
  std::mt19937 random(61);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int i = 0; i < 12; ++i) {
    const PinInVBlock v{.radius = std::pow(10, draw(0.5, 1.5)),
                        .angle = draw(0.3, 1),
                        .start = draw(0, 6),
                        .centre = Vec2(draw(-50, 50), draw(-50, 50)),
                        .edges = int(draw(4, 12)),
                        .order = 1 + i % 2,
                        .accurate = i % 3 == 2};
    SCOPED_TRACE(std::to_string(i) + ": radius " + std::to_string(v.radius) + ", angle " + std::to_string(v.angle));
    Results r = solved(v);
    EXPECT_NE(r.status, Status::not_converged);
    EXPECT_FALSE(r.unheld.empty());
    EXPECT_GT(largest_entry(r.solution.u), 0.9);
    EXPECT_LE(largest_entry(r.solution.u), 1.2);
    EXPECT_LE(std::abs(turn_of(r, "pin")) * v.radius, 5e-3);
    r.solution.unbalanced.resize(0);  // the answer still is one
    measure_residuals(r.problem.discretisation.system, r.solution);
    EXPECT_LE(r.solution.force_residual, 1e-10);
    EXPECT_LE(r.solution.constraint_residual, 1e-9);
  }
}

// A disc shrunk into a ring that a soft spring or foundation holds: whether its stiffness counts or is round-off of the
// bodies', p is the same. A foundation's normals on edges tell of the ring's spin, if only by the corners of the mesh.
TEST(FreeMotions, SoftSupportsChangeNothingHoweverSoft) {
  const TemporaryFolder folder;
  folder.write("ring.geo", R"(
Point(1) = {0, 0, 0};
For j In {0 : 3}
  Point(10 + j) = {10 * Cos(Pi * j / 2), 10 * Sin(Pi * j / 2), 0}; Point(20 + j) = {14 * Cos(Pi * j / 2), 14 * Sin(Pi * j / 2), 0};
  Point(30 + j) = {10 * Cos(Pi * j / 2), 10 * Sin(Pi * j / 2), 0};
EndFor
For j In {0 : 3}
  Circle(10 + j) = {10 + j, 1, 10 + (j + 1) % 4}; Circle(20 + j) = {20 + j, 1, 20 + (j + 1) % 4};
  Circle(30 + j) = {30 + j, 1, 30 + (j + 1) % 4};
EndFor
Curve Loop(1) = {20 : 23}; Curve Loop(2) = {10 : 13}; Curve Loop(3) = {30 : 33};
Plane Surface(1) = {1, 2}; Plane Surface(2) = {3};
Physical Surface("ring") = {1}; Physical Surface("disc") = {2}; Physical Curve("hole") = {10 : 13};
Physical Curve("out") = {20 : 23}; Physical Curve("rim") = {30 : 33}; Physical Point("pt") = {20};
Mesh.ElementOrder = 2; Mesh.MeshSizeMax = 1.5;
)");
  std::mt19937 random(5);
  std::vector<double> forces;
  for (int k = 0; k < 40; ++k) {
    const double stiffness = std::pow(10, std::uniform_real_distribution<double>(-12, 1)(random));
    SCOPED_TRACE(stiffness);
    std::ostringstream scene;
    scene << "mesh.file = \"ring.geo\"\nmaterials.steel = { young = 210e3, poisson = 0.3 }\nbodies = { \"*\" = "
             "\"steel\" }\n"
          << "contact = [{ between = [\"rim\", \"hole\"], initial_gap = -0.01 }]\nboundary = [{ on = \""
          << (k % 2 ? "out\", foundation = " : "pt\", spring = ") << stiffness << " }]\n";
    const Results r = solve_scene(read_scene(folder.write("ring.toml", scene.str())));
    EXPECT_EQ(r.status, Status::solved);
    EXPECT_LE(largest_entry(r.solution.u), 0.02);
    EXPECT_NEAR(r.recovery.contacts[0].p_max, 56.52, 0.3);  // Lame
  }
}

// Rollers without load touch at no pressure, if at all: they stay where they are, whatever rows were closed at first,
// and move no further than those that carry the shaft, by 0.05 and a little for what these leave them.
TEST(FreeMotions, RollersWithoutLoadStayWhereTheyAre) {
  std::mt19937 random(17);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (const Solver solver : {Solver::direct, Solver::direct, Solver::feti}) {
    Scene scene = read_scene(MORTISE_SOURCE_DIR "/geo/rollers.toml");
    scene.mesh_parameters = {{"rollers", int(draw(8, 15))}, {"fine", draw(0.07, 0.12)}};
    scene.method.solver = solver;
    SCOPED_TRACE(scene.mesh_parameters["rollers"]);
    const Results r = solve_scene(scene);
    EXPECT_EQ(r.status, Status::solved);
    EXPECT_LE(largest_entry(r.solution.u), 0.1);
  }
}

// A block that may slide between walls, `left` and `right` of it, and swells: from its middle, if no wall is in the
// way.
TEST(FreeMotions, WhatMaySlideStaysWhereItIsOrWhereAWallLeavesIt) {
  for (const auto& [left, right] : {std::pair{0.5, 0.5}, {0.002, 0.5}, {0.5, 0.002}}) {
    SCOPED_TRACE(std::to_string(left) + ", " + std::to_string(right));
    const TemporaryFolder folder;
    std::ostringstream geo;
    geo << "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 1, 0.5}; Rectangle(2) = {-2, -1, 0, 5, 1};\n"
        << "Rectangle(3) = {-1, 0.2, 0, " << 1 - left << ", 1}; Rectangle(4) = {" << 1 + right << ", 0.2, 0, 1, 1};\n"
        << "Physical Surface(\"block\") = {1}; Physical Surface(\"ground\") = {2}; Physical Surface(\"l\") = {3};\n"
        << "Physical Surface(\"r\") = {4}; Physical Curve(\"foot\") = {1}; Physical Curve(\"floor\") = {7};\n"
        << "Physical Curve(\"ends_l\") = {4}; Physical Curve(\"ends_r\") = {2}; Physical Curve(\"base\") = {5};\n"
        << "Physical Curve(\"wall_l\") = {10}; Physical Curve(\"wall_r\") = {16};\n"
        << "Physical Curve(\"back\") = {12, 14}; MeshSize{ : } = 0.2;\n";
    folder.write("block.geo", geo.str());
    const std::string scene =
        "mesh.file = \"block.geo\"\nmaterials.one = { young = 1000, poisson = 0, thermal_expansion = 0.01 }\n"
        "bodies = { block = \"one\", ground = \"one\", l = \"one\", r = \"one\" }\n"
        "contact = [{ between = [\"foot\", \"floor\"] }, { between = [\"ends_l\", \"wall_l\"] }, "
        "{ between = [\"ends_r\", \"wall_r\"] }]\n"
        "boundary = [{ on = [\"base\", \"back\"], displacement = { x = 0, y = 0 } }]\n"
        "body_force = [{ body = \"block\", force = [0, -1] }]\ninitial_strain = [{ body = \"block\", "
        "temperature_change = 1 "
        "}]\n";
    const Results r = solve_scene(read_scene(folder.write("block.toml", scene)));
    EXPECT_EQ(r.status, Status::solved);
    const auto moved = [&](std::size_t pair) {  // of the end that faces a wall, in its middle
      const std::vector<int> nodes = curve_nodes(r.problem.pairs[pair].multiplier);
      double sum = 0;
      for (const int node : nodes) sum += r.solution.u(2 * node);
      return sum / double(nodes.size());
    };
    EXPECT_NEAR(moved(1), left < 0.005 ? -left : right < 0.005 ? right - 0.01 : -0.005, 2e-4);
    EXPECT_NEAR(moved(2), left < 0.005 ? 0.01 - left : right < 0.005 ? right : 0.005, 2e-4);
  }
}

}  // namespace
}  // namespace mortise::test
