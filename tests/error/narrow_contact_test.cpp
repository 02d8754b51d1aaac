// Contact of round bodies on less than an edge: how wide it is.
#include "error/narrow_contact.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <sstream>

#include "app/accuracy.hpp"
#include "app/solve_scene.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

enum class Model { whole, half, ball };

// A cylinder of radius 1, or one half of it on a line of symmetry, or a ball, on a block, both of E* = 1 / 2 (1 -
// nu^2), edges h long and with a vertex at `at` on the round body, radians from its lowest point, and on the block; its
// upper face is pressed with `force`.
Scene ball(const TemporaryFolder& folder, Model model, double h, double at, double force) {
  std::ostringstream geo, scene;
  geo.precision(17), scene.precision(17);
  geo << "h = " << h << "; t = " << at << "; left = " << (model == Model::whole ? -1 : 0) << ";\n"
      << R"(Mesh.ElementOrder = 2; Mesh.MeshSizeMax = h;
Point(1) = {3 * left, -3, 0}; Point(2) = {3, -3, 0}; Point(3) = {3, 0, 0}; Point(4) = {3 * left, 0, 0};
Point(5) = {1.3 * t, 0, 0}; Point(10) = {0, 1, 0}; Point(11) = {left, 1, 0}; Point(12) = {1, 1, 0};
Point(13) = {Sin(t), 1 - Cos(t), 0}; Point(14) = {0, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 5}; Line(4) = {5, 4}; Line(5) = {4, 1};
Curve Loop(1) = {1 : 5}; Plane Surface(1) = {1};
Circle(11) = {left < 0 ? 11 : 14, 10, 13}; Circle(12) = {13, 10, 12};
If (left < 0)
  Line(13) = {12, 11}; Curve Loop(2) = {11 : 13};
Else
  Line(13) = {12, 10}; Line(14) = {10, 14}; Curve Loop(2) = {11 : 14};
EndIf
Plane Surface(2) = {2};
Physical Surface("block") = {1}; Physical Surface("ball") = {2};
Physical Curve("axis") = {left < 0 ? 13 : 14, 5};
Physical Curve("round") = {11, 12}; Physical Curve("flat") = {3, 4}; Physical Curve("top") = {13}; Physical Curve("foot") = {1};
)";
  folder.write("a.geo", geo.str());
  scene << "mesh.file = \"a.geo\"\n"
        << (model == Model::ball ? "model.plane = \"axisymmetric\"\n" : "")
        << R"(materials.one = { young = 1, poisson = 0.3 }
bodies = { block = "one", ball = "one" }
boundary = [)"
        << (model == Model::half ? "{ on = \"axis\", displacement = { x = 0 } }, " : "")
        << R"({ on = "foot", displacement = { x = 0, y = 0 } }, { on = "top", rigid = { )"
        << (model == Model::ball ? "" : "x = 0, rotation = 0, ") << R"(force = [0, )" << -force << R"(] } }]
contact = [{ between = ["round", "flat"] }]
)";
  return read_scene(folder.write("a.toml", scene.str()));
}

std::set<int> body_nodes(const Mesh& mesh, const std::string& body) {
  std::set<int> nodes;
  for (const Cell& cell : mesh.cells)
    if (mesh.bodies[cell.body] == body) nodes.insert(cell.nodes.begin(), cell.nodes.begin() + node_count(cell.kind));
  return nodes;
}

TEST(NarrowContact, IsAsWideAsHertzHasIt) {
  std::mt19937 random(8);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const double modulus = 0.5 / (1 - 0.3 * 0.3);
  for (int k = 0; k < 24; ++k) {
    const Model model = std::array{Model::whole, Model::half, Model::ball}[k % 3];
    const double h = draw(0.1, 0.3), half = h * std::pow(10, draw(-3, -0.5));
    const double cylinder = std::numbers::pi * modulus * half * half / 4,
                 force = model == Model::ball   ? 4 * modulus * std::pow(half, 3) / 3
                         : model == Model::half ? cylinder / 2
                                                : cylinder,
                 at = draw(0.2, 1.5) * h * (model == Model::whole ? std::copysign(1, draw(-1, 1)) : 1);
    SCOPED_TRACE(std::to_string(k) + ": " + std::to_string(half / h));
    const TemporaryFolder folder;
    Results r = solve_scene(ball(folder, model, h, at, force));
    estimate(r);
    const std::vector<LineError::Narrow>& narrow = r.estimate->pressures[0].local.narrow_at;
    ASSERT_GE(narrow.size(), 6u);
    for (std::size_t i = 0; i < narrow.size(); ++i) {  // an end, the middle, the other end, of either side
      EXPECT_NEAR(narrow[i].edge, half / edges_of_contact, 0.25 * half / edges_of_contact);
      EXPECT_LE(std::abs(narrow[i].place.y()), half);
      EXPECT_LE(std::abs(std::abs(narrow[i].place.x()) - (i % 3 == 1 ? 0 : half)), 0.6 * half) << i;
    }
  }
}

TEST(NarrowContact, IsNoneWhereEdgesShowIt) {
  const double modulus = 0.5 / (1 - 0.3 * 0.3), half = 0.3;
  const TemporaryFolder folder;
  Results r = solve_scene(ball(folder, Model::whole, 0.05, 0.01, std::numbers::pi * modulus * half * half / 4));
  estimate(r);
  EXPECT_TRUE(r.estimate->pressures[0].local.narrow_at.empty());
}

// A block that tilts beneath a ball on a coarse mesh takes the least of the gap away from the ball's lowest point.
TEST(NarrowContact, IsWhereBodiesAreDrawnNearestToo) {
  const double modulus = 0.5 / (1 - 0.3 * 0.3), half = 0.002;
  const TemporaryFolder folder;
  Results r = solve_scene(ball(folder, Model::whole, 0.2, 0.05, std::numbers::pi * modulus * half * half / 4));
  estimate(r);
  std::vector<PressureEstimate> list = r.estimate->pressures;
  list[0].local.narrow_at.clear();
  VecX u = r.solution.u;
  const Mesh& mesh = r.problem.mesh;
  for (const int node : body_nodes(mesh, "block"))
    u.segment<2>(2 * node) += 0.5 * Vec2(-mesh.nodes(node, 1), mesh.nodes(node, 0));
  add_narrow_contact(r.problem, u, list);
  ASSERT_EQ(list[0].local.narrow_at.size(), 6u);
  for (const int middle : {1, 4}) EXPECT_LE(list[0].local.narrow_at[middle].place.norm(), half);
}

// A corner between faces that lean by 2 and by 40 degrees is no round body, however little it is pressed.
TEST(NarrowContact, IsNoneUnderACorner) {
  const TemporaryFolder folder;
  folder.write("a.geo", R"(Mesh.ElementOrder = 2; Mesh.MeshSizeMax = 0.2; d = Pi / 180;
Point(1) = {-3, -3, 0}; Point(2) = {3, -3, 0}; Point(3) = {3, 0, 0}; Point(4) = {-3, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Point(11) = {-1, Tan(2 * d), 0}; Point(12) = {0, 0, 0}; Point(13) = {1, Tan(40 * d), 0}; Point(14) = {1, 2, 0}; Point(15) = {-1, 2, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 15}; Line(15) = {15, 11};
Curve Loop(2) = {11 : 15}; Plane Surface(2) = {2};
Physical Surface("block") = {1}; Physical Surface("foot") = {2};
Physical Curve("ground") = {1}; Physical Curve("flat") = {3}; Physical Curve("sole") = {11, 12}; Physical Curve("top") = {14};
)");
  Results r = solve_scene(read_scene(folder.write("a.toml", R"(mesh.file = "a.geo"
materials.one = { young = 1, poisson = 0.3 }
bodies = { block = "one", foot = "one" }
boundary = [{ on = "ground", displacement = { x = 0, y = 0 } }, { on = "top", rigid = { x = 0, rotation = 0, force = [0, -1e-5] } }]
contact = [{ between = ["sole", "flat"], multipliers_on = "sole" }]
)")));
  estimate(r);
  EXPECT_TRUE(r.estimate->pressures[0].line.p.any());
  EXPECT_TRUE(r.estimate->pressures[0].local.narrow_at.empty());
}

// Three pipes in a rack under their own weight, which touch on 1e-4 of their radius. Their forces are known on a mesh
// on which one of them still spins, so that it parts from its neighbours or goes through them.
TEST(NarrowContact, OfPipesInARackIsFoundBeforeTheyRest) {
  const TemporaryFolder folder;
  folder.write("rack.geo", R"(SetFactory("OpenCASCADE");
x[] = {0, 100, 50}; y[] = {50, 50, 50 + 50 * Sqrt(3)};
For k In {0 : 2}
  o = 100 * k + 100; Disk(o) = {x[k], y[k], 0, 50}; Disk(o + 1) = {x[k], y[k], 0, 42};
  BooleanDifference(o + 2) = {Surface{o}; Delete;}{Surface{o + 1}; Delete;};
  Physical Surface(Sprintf("pipe_%g", k)) = {o + 2}; b() = Boundary{Surface{o + 2};}; Physical Curve(Sprintf("o%g", k)) = {b(0)};
EndFor
p = newp; c = newc;
Point(p) = {-50, 0, 0}; Point(p + 1) = {150, 0, 0}; Point(p + 2) = {150, 150, 0}; Point(p + 3) = {180, 150, 0};
Point(p + 4) = {180, -30, 0}; Point(p + 5) = {-80, -30, 0}; Point(p + 6) = {-80, 150, 0}; Point(p + 7) = {-50, 150, 0};
For k In {0 : 7}
  Line(c + k) = {p + k, p + (k + 1) % 8};
EndFor
Curve Loop(1000) = {c : c + 7}; Plane Surface(1000) = {1000};
Physical Surface("rack") = {1000};
Physical Curve("floor") = {c}; Physical Curve("right") = {c + 1}; Physical Curve("left") = {c + 7}; Physical Curve("base") = {c + 4};
)");
  const Scene scene = read_scene(folder.write("rack.toml", R"(mesh.file = "rack.geo"
model.gravity = [0, -9810]
materials.steel = { young = 206e3, poisson = 0.3, density = 7.85e-9 }
bodies."*" = "steel"
boundary = [{ on = "base", displacement = { x = 0, y = 0 } }]
contact = [{ between = ["o*", "o*"] }, { between = ["o*", "floor"] }, { between = ["o*", "left"] }, { between = ["o*", "right"] }]
accuracy.value = "5%"
)"));
  const auto r = solve_to_accuracy(scene);
  EXPECT_TRUE(r->accuracy->reached()) << r->accuracy->reason;
  EXPECT_LE(r->accuracy->solves.size(), 6u);
  Scene other = scene;  // what both pipes of the lowest layer press with, which the first mesh has at zero
  other.accuracy->of = Goal::force;
  const auto force = solve_to_accuracy(other);
  EXPECT_TRUE(force->accuracy->reached()) << force->accuracy->reason;
  const double exact = r->recovery.contacts[0].force.norm();
  EXPECT_GT(exact, 0);
  EXPECT_NEAR(force->recovery.contacts[0].force.norm(), exact, 0.06 * exact);
}

}  // namespace
}  // namespace mortise::test
