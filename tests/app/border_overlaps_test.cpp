// Forces, displacements and pressures where a mesh hardly sees contact: a ring on a plate touches by far less than an
// edge, and so does the corner of a foot.
#include "error/border_overlaps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

#include "app/accuracy.hpp"
#include "results/error_report.hpp"
#include "support/pressure_at.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// A quarter of a ring of radius 10, its foot moved down by `push`.
std::string ring(double thickness) {
  std::ostringstream geo;
  const double inner = 10 - thickness;
  geo << "Point(1) = {0, -10, 0}; Point(2) = {10, 0, 0}; Point(3) = {0, 0, 0}; Point(4) = {" << inner << ", 0, 0};\n"
      << "Point(5) = {0, " << -inner
      << ", 0}; Point(6) = {0, -15, 0}; Point(7) = {8, -15, 0}; Point(8) = {8, -10, 0};\n"
      << "Point(9) = {0, -10, 0}; Circle(1) = {1, 3, 2}; Line(2) = {2, 4}; Circle(3) = {4, 3, 5}; Line(4) = {5, 1};\n"
      << "Line(5) = {6, 7}; Line(6) = {7, 8}; Line(7) = {8, 9}; Line(8) = {9, 6};\n"
      << "Curve Loop(1) = {1 ... 4}; Plane Surface(1) = {1}; Curve Loop(2) = {5 ... 8}; Plane Surface(2) = {2};\n"
      << "Physical Surface(\"ring\") = {1}; Physical Surface(\"plate\") = {2}; Physical Curve(\"out\") = {1};\n"
      << "Physical Curve(\"foot\") = {2}; Physical Curve(\"middle\") = {4, 8}; Physical Curve(\"ground\") = {5};\n"
      << "Physical Curve(\"top\") = {7};\n";
  return geo.str();
}

Scene scene_of(const TemporaryFolder& folder, double thickness, double push, const std::string& asked) {
  folder.write("ring.geo", ring(thickness));
  std::ostringstream toml;
  toml << "mesh.file = \"ring.geo\"\nmaterials.steel = { young = 210e3, poisson = 0.3 }\n"
       << "bodies = { ring = \"steel\", plate = \"steel\" }\ncontact = [{ between = [\"out\", \"top\"] }]\n"
       << "boundary = [{ on = \"middle\", displacement = { x = 0 } }, { on = \"ground\", displacement = { y = 0 } },\n"
       << "  { on = \"foot\", rigid = { y = " << -push << ", rotation = 0 } }]\n[accuracy]\n"
       << asked << "\n";
  return read_scene(folder.write("ring.toml", toml.str()));
}

// The thinner the ring, the more of the answer is how far it moves before it touches.
TEST(BorderOverlaps, ForcesAndDisplacementsAreRightWhereContactIsLessThanAnEdge) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> power(-0.7, 0.5);
  for (int k = 0; k < 4; ++k) {
    const double thickness = std::pow(10, power(random)), push = 2e-3 * std::pow(10, power(random));
    const TemporaryFolder folder;
    const auto exact = solve_to_accuracy(scene_of(folder, thickness, push, "value = 0.001"));
    ASSERT_TRUE(exact) << k;
    const double force = exact->recovery.contacts[0].force.y();
    for (const char* value : {"0.05", "0.01"}) {
      const auto r =
          solve_to_accuracy(scene_of(folder, thickness, push, std::string("of = \"force\"\nvalue = ") + value));
      ASSERT_TRUE(r) << k;
      EXPECT_NEAR(r->recovery.contacts[0].force.y(), force, std::stod(value) * std::abs(force)) << k << " " << value;
      EXPECT_LE(std::abs(r->recovery.contacts[0].force.y() - force), r->recovery.contacts[0].force_error->y()) << k;
    }
  }
}

// Half of a punch with a chamfer behind the corner of its foot, on a block; `angle`, radians, is the chamfer's with the
// block's top, the foot's curve goes on along it.
std::string chamfered_punch(double width, double height, double chamfer, double angle) {
  std::ostringstream geo;
  geo << "Point(1) = {0, -11, 0}; Point(2) = {34, -11, 0}; Point(3) = {34, 0, 0}; Point(4) = {0, 0, 0};\n"
      << "Point(5) = {0, 0, 0}; Point(6) = {" << width << ", 0, 0}; Point(7) = {" << width + chamfer << ", "
      << chamfer * std::tan(angle) << ", 0};\n"
      << "Point(8) = {" << width + chamfer << ", " << height << ", 0}; Point(9) = {0, " << height << ", 0};\n"
      << "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Line(5) = {5, 6}; Line(6) = {6, 7};\n"
      << "Line(7) = {7, 8}; Line(8) = {8, 9}; Line(9) = {9, 5}; Curve Loop(1) = {1 ... 4}; Plane Surface(1) = {1};\n"
      << "Curve Loop(2) = {5 ... 9}; Plane Surface(2) = {2}; Physical Surface(\"base\") = {1};\n"
      << "Physical Surface(\"punch\") = {2}; Physical Curve(\"ground\") = {1}; Physical Curve(\"top\") = {3};\n"
      << "Physical Curve(\"foot\") = {5, 6}; Physical Curve(\"head\") = {8}; Physical Curve(\"middle\") = {4, 9};\n";
  return geo.str();
}

// Heated, it curls up and stands on the corner of its foot, by far less than an edge.
Scene curled(const TemporaryFolder& folder, std::mt19937& random, const std::string& asked) {
  std::uniform_real_distribution<double> any(0, 1);
  const double width = 15 + 5 * any(random), height = 10 + 15 * any(random), chamfer = 1 + 2 * any(random),
               angle = 0.03 + 0.7 * any(random), heat = 30 + 70 * any(random);
  std::ostringstream toml;
  folder.write("curled.geo", chamfered_punch(width, height, chamfer, angle));
  toml << "mesh.file = \"curled.geo\"\nmodel.plane = \"" << (any(random) < 0.5 ? "strain" : "axisymmetric") << "\"\n"
       << "materials.b = { young = 14120, poisson = 0.45 }\n"
       << "materials.p = { young = 5138, poisson = 0.45, thermal_expansion = 1e-5 }\n"
       << "bodies = { base = \"b\", punch = \"p\" }\ncontact = [{ between = [\"foot\", \"top\"] }]\n"
       << "boundary = [{ on = \"ground\", displacement = { y = 0 } }, { on = \"head\", pressure = 0.323 },\n"
       << "  { on = \"middle\", displacement = { x = 0 } }]\n"
       << "initial_strain = [{ body = \"punch\", temperature_change = " << heat << " }]\n"
       << "accuracy.value = " << asked << "\n";
  return read_scene(folder.write("curled.toml", toml.str()));
}

// Where the foot's middle presses p is as good as was asked.
TEST(BorderOverlaps, PressureIsRightWhereAnotherContactIsLessThanAnEdge) {
  for (int seed = 1; seed <= 4; ++seed) {
    const TemporaryFolder folder;
    std::mt19937 random(seed), again(seed);
    const auto exact = solve_to_accuracy(curled(folder, random, "0.001"));
    const auto found = solve_to_accuracy(curled(folder, again, "0.01"));
    ASSERT_TRUE(exact && found) << seed;
    for (const double x : {0.5, 3.0, 6.0}) {
      const double p = pressure_at(exact->recovery.contacts[0].multiplier.nodes, x);
      ASSERT_GT(p, 0) << seed;
      EXPECT_NEAR(pressure_at(found->recovery.contacts[0].multiplier.nodes, x), p, 0.01 * p) << seed << " " << x;
    }
  }
}

// Pressed on the block, with the multipliers on the foot.
Scene chamfered(const TemporaryFolder& folder, std::mt19937& random) {
  std::uniform_real_distribution<double> any(0, 1);
  const double width = 15 + 5 * any(random), height = 5 + 15 * any(random), chamfer = 1 + 2 * any(random),
               angle = 0.2 + 0.6 * any(random), young = 1000 * std::pow(7, any(random));
  std::ostringstream toml;
  folder.write("chamfered.geo", chamfered_punch(width, height, chamfer, angle));
  toml << "mesh.file = \"chamfered.geo\"\nmaterials.b = { young = 1000, poisson = 0.3 }\n"
       << "materials.p = { young = " << young << ", poisson = 0.3 }\n"
       << "bodies = { base = \"b\", punch = \"p\" }\n"
       << "contact = [{ between = [\"foot\", \"top\"], multipliers_on = \"foot\" }]\n"
       << "boundary = [{ on = \"ground\", displacement = { y = 0 } }, { on = \"head\", pressure = 0.3 },\n"
       << "  { on = \"middle\", displacement = { x = 0 } }]\naccuracy.value = 0.01\n";
  return read_scene(folder.write("chamfered.toml", toml.str()));
}

// The row at the corner, half of which is the chamfer's gap, is open, and p is zero there however short the edges.
TEST(BorderOverlaps, APunchStandsOnTheCornerBeforeItsChamfer) {
  for (int seed = 1; seed <= 5; ++seed) {
    const TemporaryFolder folder;
    std::mt19937 random(seed);
    const auto r = solve_to_accuracy(chamfered(folder, random));
    ASSERT_TRUE(r) << seed;
    EXPECT_TRUE(r->accuracy->reached()) << seed;
    EXPECT_LE(r->accuracy->solves.size(), 4u) << seed;
    ASSERT_EQ(r->estimate->pressures[0].singular.size(), 1u) << seed;
    EXPECT_NEAR(r->estimate->pressures[0].singular[0].pressure_exponent, 0.5, 0.3) << seed;
  }
}

}  // namespace
}  // namespace mortise::test
