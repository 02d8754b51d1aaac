// Bodies that only contact holds stand or fall as statics says.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>

#include "app/solve_scene.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

Scene logs(double width, const std::string& order, const std::string& edges) {
  return read_scene(std::string(MORTISE_SOURCE_DIR) + "/tests/parts/logs.toml",
                    {{"mesh.parameters.width", std::to_string(width)},
                     {"mesh.parameters.order", order},
                     {"mesh.parameters.fine", edges}});
}

// A mesh of uneven edges has the weight of its disc beside the centre, by as much as the edges leave the circle.
TEST(Statics, TheWeightOfAnUnevenMeshTurnsNoDisc) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> widths(2.2, 3.6);
  for (const char* order : {"1", "2"})
    for (const char* edges : {"0.02", "0.05", "0.1"}) {
      const double width = widths(random);
      SCOPED_TRACE("order " + std::string(order) + ", edges " + edges + ", width " + std::to_string(width));
      EXPECT_NO_THROW(check_scene(logs(width, order, edges)));
    }
}

TEST(Statics, LogsPressOnOneAnotherAsStaticsSays) {
  const Results r = solve_scene(logs(3.2, "2", "0.05"));
  EXPECT_EQ(r.status, Status::solved);
  const double weight = 600 * 9.81 * std::numbers::pi;  // per length, of radius 1
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k) {
    const std::string other = r.problem.pairs[k].spec.between[1];
    const double expected = other == "floor" ? 2 * weight : other.starts_with("rim") ? weight : 0;
    EXPECT_NEAR(std::abs(r.recovery.contacts[k].force.y()), expected, 0.005 * weight) << other;
  }
}

// An arch of stones with joints that have no friction stands if each weighs H (tan b - tan a), with a and b its joints'
// angles from the vertical and H the thrust (La Hire 1695): under c (1 + (x / y)^2) a volume. `heavier`: of one stone.
struct Arch {
  int stones = 9, edges = 12, order = 2;
  double half = 60, inner = 4, heavier = 1;  // degrees, length
};

Results solved_arch(const Arch& a) {
  const TemporaryFolder folder;
  std::ostringstream geo, scene;
  geo << "stones = " << a.stones << "; half = " << a.half << "; R = " << a.inner << "; n = " << a.edges << R"(;
For k In {0 : stones - 1}
  a = Pi / 180 * half * (2 * k / stones - 1); b = Pi / 180 * half * (2 * (k + 1) / stones - 1);
  p = newp; c = newc; s = news;
  Point(p) = {0, 0, 0};
  Point(p + 1) = {R * Sin(a), R * Cos(a), 0}; Point(p + 2) = {(R + 1) * Sin(a), (R + 1) * Cos(a), 0};
  Point(p + 3) = {(R + 1) * Sin(b), (R + 1) * Cos(b), 0}; Point(p + 4) = {R * Sin(b), R * Cos(b), 0};
  Line(c) = {p + 1, p + 2}; Circle(c + 1) = {p + 2, p, p + 3};
  Line(c + 2) = {p + 3, p + 4}; Circle(c + 3) = {p + 4, p, p + 1};
  Curve Loop(s) = {c : c + 3}; Plane Surface(s) = {s};
  Physical Surface(Sprintf("stone_%g", k)) = {s};
  Physical Curve(Sprintf("left_%g", k)) = {c}; Physical Curve(Sprintf("right_%g", k)) = {c + 2};
  MeshSize{ p + 1, p + 2, p + 3, p + 4 } = 1 / (n + k % 2);
EndFor
Mesh.ElementOrder = )"
      << a.order << ";\n";
  folder.write("arch.geo", geo.str());
  scene
      << "mesh.file = \"arch.geo\"\nmaterials.stone = { young = 2e4, poisson = 0.2 }\nbodies.\"stone_*\" = \"stone\"\n"
      << "boundary = [{ on = [\"left_0\", \"right_" << a.stones - 1 << "\"], displacement = { x = 0, y = 0 } }]\n"
      << "contact = [{ between = [\"right_*\", \"left_*\"] }]\n"
      << "body_force = [{ body = \"stone_*\", force = [0, \"-(1 + (x / y)^2)\"] }, "
      << "{ body = \"stone_1\", force = [0, \"" << -a.heavier << " * (1 + (x / y)^2)\"] }]\n";
  return solve_scene(read_scene(folder.write("arch.toml", scene.str())));
}

// The stones weigh on a mesh what they weigh as drawn but for the area between their edges and the arcs.
TEST(Statics, AnArchStandsOnAnyMeshOfItsStones) {
  std::mt19937 random(7);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int i = 0; i < 12; ++i) {
    const Arch arch{.stones = int(draw(3, 12)),
                    .edges = int(draw(2, 9)),
                    .order = 1 + i % 2,
                    .half = draw(30, 70),
                    .inner = draw(1.5, 8)};
    SCOPED_TRACE(std::to_string(arch.stones) + " stones, " + std::to_string(arch.edges) + " edges, order " +
                 std::to_string(arch.order) + ", half " + std::to_string(arch.half) + ", inner " +
                 std::to_string(arch.inner));
    std::optional<Results> solved;
    ASSERT_NO_THROW(solved = solved_arch(arch));
    const Results& r = *solved;
    EXPECT_NE(r.status, Status::not_converged);
    const double thrust = arch.inner + 0.5;
    for (const ContactResults& joint : r.recovery.contacts)
      EXPECT_NEAR(std::abs(joint.force.x()), thrust, (arch.order == 1 ? 3e-2 : 1e-3) * thrust);
  }
}

TEST(Statics, AnArchWithAStoneTooHeavyFalls) {
  for (const double heavier : {1 - 1e-5, 1 + 1e-5})
    expect_contains(message_of([&] { solved_arch({.heavier = heavier}); }), "nothing holds body 'stone_");
}

// A block of width 1 on a wider one, its load's resultant a distance from its left end, on edges of a size.
Results tipped(double from_end, double edge, int order) {
  const TemporaryFolder folder;
  std::ostringstream geo, scene;
  geo << "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 1, 1}; Rectangle(2) = {-0.5, -1, 0, 2, 1};\n"
      << "Physical Surface(\"block\") = {1}; Physical Surface(\"ground\") = {2};\n"
      << "Physical Curve(\"foot\") = {1}; Physical Curve(\"top\") = {3}; Physical Curve(\"floor\") = {7};\n"
      << "Physical Curve(\"base\") = {5}; MeshSize{ : } = 0.3; MeshSize{ 1, 2 } = " << edge
      << "; Mesh.ElementOrder = " << order << ";\n";
  folder.write("block.geo", geo.str());
  scene << "mesh.file = \"block.geo\"\nmaterials.one = { young = 1000, poisson = 0.3 }\n"
        << "bodies = { block = \"one\", ground = \"one\" }\ncontact = [{ between = [\"foot\", \"floor\"] }]\n"
        << "boundary = [{ on = \"base\", displacement = { x = 0, y = 0 } },\n"
        << "{ on = \"top\", traction = [0, \"-1 - 12 * " << 0.5 - from_end << " * (0.5 - x)\"] }]\n";
  return solve_scene(read_scene(folder.write("block.toml", scene.str())));
}

// Pressures that are linear along the edges reach no nearer to the end than a third of the last one.
TEST(Statics, ALoadThatOnlyAFinerMeshCarriesIsToldFromOneThatNothingCarries) {
  std::mt19937 random(29);
  std::uniform_real_distribution<double> part(0.05, 0.3), size(0.1, 0.5);
  for (int i = 0; i < 8; ++i) {
    const double edge = 1 / std::round(1 / size(random)), from_end = part(random) * edge;
    const int order = 1 + i % 2;
    SCOPED_TRACE(std::to_string(edge) + ", " + std::to_string(from_end));
    expect_contains(message_of([&] { tipped(from_end, edge, order); }), "on this mesh; expected shorter edges");
    EXPECT_NE(tipped(from_end, from_end, order).status, Status::not_converged);
    expect_contains(message_of([&] { tipped(-from_end, edge, order); }), "contact; expected a load that presses it on");
  }
}

}  // namespace
}  // namespace mortise::test
