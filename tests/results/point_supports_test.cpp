// Supports at points, which take less the finer the mesh is there.
#include "results/point_supports.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <sstream>

#include "app/accuracy.hpp"
#include "app/solve_scene.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// A block, held at its left side where `left` says so and at a point of its underside, bears another. `at_point`: what
// holds there, elements `size` long.
Results propped(double x, double size, const std::string& left, const std::string& at_point,
                const std::string& more = "") {
  const TemporaryFolder folder;
  std::ostringstream geo;
  const bool at_corner = x == 6;
  geo << "Mesh.ElementOrder = 2; Point(1) = {0, -2, 0, 0.5}; Point(2) = {" << (at_corner ? 3 : x) << ", -2, 0, "
      << (at_corner ? 0.5 : size) << "}; Point(3) = {6, -2, 0, " << (at_corner ? size : 0.5)
      << "}; Physical Point(\"prop\") = {" << (at_corner ? 3 : 2)
      << R"(}; Point(4) = {6, 0, 0, 0.2}; Point(5) = {0, 0, 0, 0.2};
Point(6) = {1, 0, 0, 0.2}; Point(7) = {5, 0, 0, 0.2}; Point(8) = {5, 1.5, 0, 0.5}; Point(9) = {1, 1.5, 0, 0.5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 9}; Line(9) = {9, 6};
Curve Loop(1) = {1 : 5}; Plane Surface(1) = {1}; Curve Loop(2) = {6 : 9}; Plane Surface(2) = {2};
Physical Surface("lower") = {1}; Physical Surface("upper") = {2};
Physical Curve("left") = {5}; Physical Curve("seat") = {4}; Physical Curve("foot") = {6}; Physical Curve("head") = {8};)";
  folder.write("prop.geo", geo.str());
  const Scene scene = read_scene(folder.write("scene.toml", R"(mesh.file = "prop.geo"
materials.m = { young = 1000, poisson = 0.3 }
bodies = { lower = "m", upper = "m" }
contact = [{ between = ["foot", "seat"] }]
boundary = [{ on = "prop", )" + at_point + R"( }, { on = "head", pressure = "1 + x / 5" },
  { on = "head", displacement = { x = 0 } }, { on = "left", )" + left +
                                                                " }]\n" + more));
  return scene.accuracy ? *solve_to_accuracy(scene) : solve_scene(scene);
}

double force_at(const Results& r) { return r.recovery.reactions.entries[0].force.y(); }

// p along the line, as far as the mesh there allows: two meshes are alike but for the elements at the point.
double part_changed(const Results& one, const Results& other) {
  double off = 0, whole = 0;
  const auto &a = one.recovery.contacts[0].multiplier.nodes, &b = other.recovery.contacts[0].multiplier.nodes;
  for (std::size_t i = 1; i + 1 < std::min(a.size(), b.size()); ++i) {
    EXPECT_NEAR(a[i].position.x(), b[i].position.x(), 1e-9);
    off += std::abs(a[i].p - b[i].p);
    whole += std::abs(a[i].p);
  }
  return off / whole;
}

bool is_told(const Results& r, const std::string& words) {
  return std::ranges::any_of(r.warnings, [&](const std::string& line) { return line.find(words) != line.npos; });
}

TEST(PointSupports, ChangePAsTheirElementsBecomeShorter) {
  std::mt19937 random(3);
  for (int k = 0; k < 6; ++k) {
    const double x = k < 4 ? std::uniform_real_distribution(2.0, 5.0)(random) : 6,
                 stiffness = std::uniform_real_distribution(200.0, 3000.0)(random);
    const std::string prop = k % 2 == 0 ? "displacement = { y = 0 }" : "spring = " + std::to_string(stiffness);
    const Results coarse = propped(x, 0.1, "displacement = { x = 0, y = 0 }", prop),
                  fine = propped(x, 0.01, "displacement = { x = 0, y = 0 }", prop);
    const double told = changes_by_point_supports(coarse)[0], found = part_changed(coarse, fine);
    EXPECT_LT(force_at(fine), force_at(coarse)) << prop;
    EXPECT_GT(told, 0.002) << prop;
    EXPECT_NEAR(told, found, 0.3 * found) << prop << " at " << x;
  }
}

TEST(PointSupports, ChangeNothingThatEquilibriumGives) {
  for (const std::string prop : {"displacement = { y = 0 }", "spring = [0, 800]"}) {
    const Results r = propped(3, 0.05, "displacement = { x = 0 }", prop);
    EXPECT_LT(changes_by_point_supports(r)[0], 1e-6) << prop;
    EXPECT_TRUE(is_told(r, "the displacement there are unbounded and grow as the mesh is refined; results a few"));
  }
}

// The corner of a curve that rollers hold, pinned along them, is how plates are held as a rule: what the corner bears
// of the rollers' load is not the point's, whichever stands first.
TEST(PointSupports, BearNothingOfTheCurvesThatTheyAreOn) {
  const std::string rollers = R"({ on = "seat_foot", displacement = { y = 0 } })";
  for (const std::string pin : {"{ x = 0 }", "{ x = 0, y = 0 }"})
    for (const bool first : {false, true}) {
      const TemporaryFolder folder;
      folder.write("blocks.geo", R"(SetFactory("OpenCASCADE"); Mesh.MeshSizeMax = 0.4; Mesh.ElementOrder = 2;
Rectangle(1) = {0, 0, 0, 2, 1}; Rectangle(2) = {0, 1, 0, 2, 1}; a() = Boundary{ Surface{1}; }; b() = Boundary{ Surface{2}; };
Physical Surface("lower") = {1}; Physical Surface("upper") = {2}; Physical Curve("seat_foot") = {a(0)};
Physical Curve("seat") = {a(2)}; Physical Curve("foot") = {b(0)}; Physical Curve("head") = {b(2)};
Physical Point("corner") = {1};)");
      const std::string corner = R"({ on = "corner", displacement = )" + pin + " }";
      const Results r = solve_scene(read_scene(folder.write("scene.toml", R"(mesh.file = "blocks.geo"
materials.m = { young = 1000, poisson = 0.3 }
bodies = { lower = "m", upper = "m" }
contact = [{ between = ["foot", "seat"] }]
boundary = [{ on = "head", pressure = 3 }, )" + (first ? corner + ", " + rollers : rollers + ", " + corner) +
                                                                              "]\n")));
      EXPECT_NEAR(r.recovery.reactions.entries[first ? 2 : 1].force.y(), 6, 1e-9);
      for (const double change : changes_by_point_supports(r)) EXPECT_LT(change, 1e-9) << pin << ' ' << first;
    }
}

TEST(PointSupports, AreWarnedOfWithTheirShare) {
  EXPECT_TRUE(is_told(propped(4.5, 0.05, "displacement = { x = 0, y = 0 }", "displacement = { y = 0 }"),
                      "elements there a tenth as long change p by another"));
}

TEST(PointSupports, HaveNoPThatAnAccuracyCouldReach) {
  const auto reached = [](const std::string& left, const std::string& asked) {
    return propped(4.5, 1, left, "displacement = { y = 0 }", "accuracy.value = \"" + asked + "\"\n");
  };
  const Results r = reached("displacement = { x = 0, y = 0 }", "1%");
  EXPECT_EQ(r.status, Status::accuracy_not_reached);
  EXPECT_LE(r.estimate->pressure(), 0.01);
  EXPECT_TRUE(r.accuracy->reason.starts_with("elements a tenth as long at a support at a point change p by another "))
      << r.accuracy->reason;
  EXPECT_TRUE(reached("displacement = { x = 0 }", "1%").accuracy->reached());  // equilibrium gives its force
  EXPECT_TRUE(reached("displacement = { x = 0, y = 0 }", "30%").accuracy->reached());
}

}  // namespace
}  // namespace mortise::test
