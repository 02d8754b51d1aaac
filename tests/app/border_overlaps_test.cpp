// Forces and displacements where a mesh hardly sees contact: a ring on a plate touches by far less than an edge.
#include "error/border_overlaps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

#include "app/accuracy.hpp"
#include "results/error_report.hpp"
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

}  // namespace
}  // namespace mortise::test
