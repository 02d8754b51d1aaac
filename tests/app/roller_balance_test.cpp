// Bodies that nothing but contact holds are in balance under its forces alone, whichever side has the multipliers.
#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "app/accuracy.hpp"
#include "app/solve_scene.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// Discs of radius 1 in a row between a held wall at the left and a plate at the right, pushed against the wall.
std::string discs_between_plates(int count) {
  std::ostringstream out;
  const auto plate = [&](int first, double x, const char* name, const char* face, const char* back, bool right) {
    out << "Point(" << first << ") = {" << x << ", -1.5, 0}; Point(" << first + 1 << ") = {" << x + 1
        << ", -1.5, 0}; Point(" << first + 2 << ") = {" << x + 1 << ", 1.5, 0}; Point(" << first + 3 << ") = {" << x
        << ", 1.5, 0};\n";
    for (int k = 0; k < 4; ++k)
      out << "Line(" << first + k << ") = {" << first + k << ", " << first + (k + 1) % 4 << "};\n";
    out << "Curve Loop(" << first << ") = {" << first << ":" << first + 3 << "}; Plane Surface(" << first << ") = {"
        << first << "}; Physical Surface(\"" << name << "\") = {" << first << "}; Physical Curve(\"" << face
        << "\") = {" << first + (right ? 3 : 1) << "}; Physical Curve(\"" << back << "\") = {"
        << first + (right ? 2 : 3) << "};\n";
  };
  plate(100, -2, "wall", "wall_face", "wall_back", false);
  for (int k = 0; k < count; ++k) {
    const int first = 1000 + 100 * k;
    const double x = 2 * k;
    out << "Point(" << first << ") = {" << x << ", 0, 0}; Point(" << first + 1 << ") = {" << x + 1 << ", 0, 0}; Point("
        << first + 2 << ") = {" << x << ", 1, 0}; Point(" << first + 3 << ") = {" << x - 1 << ", 0, 0}; Point("
        << first + 4 << ") = {" << x << ", -1, 0};\n";
    for (int i = 0; i < 4; ++i)
      out << "Circle(" << first + i << ") = {" << first + 1 + i << ", " << first << ", " << first + 1 + (i + 1) % 4
          << "};\n";
    out << "Curve Loop(" << first << ") = {" << first << ":" << first + 3 << "}; Plane Surface(" << first << ") = {"
        << first << "}; Physical Surface(\"disc" << k << "\") = {" << first << "}; Physical Curve(\"rim" << k
        << "\") = {" << first << ":" << first + 3 << "};\n";
  }
  plate(200, 2 * count - 1, "pusher", "pusher_face", "pusher_top", true);
  out << "MeshSize{:} = 0.3; Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;\n";
  return out.str();
}

std::string scene_of(int count, bool first_side) {
  std::ostringstream out;
  out << "[mesh]\nfile = \"discs.geo\"\n[materials]\none = { young = 1.0, poisson = 0.3 }\n[bodies]\nwall = \"one\"\n"
      << "pusher = \"one\"\n\"disc*\" = \"one\"\n[[boundary]]\non = \"wall_back\"\ndisplacement = { x = 0, y = 0 }\n"
      << "[[boundary]]\non = \"pusher_top\"\ndisplacement = { y = 0 }\n"
      << "[[body_force]]\nbody = \"pusher\"\nforce = [-1e-6, 0]\n";
  for (int k = 0; k <= count; ++k) {
    const std::string one = k == 0 ? "wall_face" : "rim" + std::to_string(k - 1),
                      two = k == count ? "pusher_face" : "rim" + std::to_string(k);
    out << "[[contact]]\nbetween = [\"" << one << "\", \"" << two << "\"]\nmultipliers_on = \""
        << (first_side ? one : two) << "\"\n";
  }
  return out.str();
}

Results solved(int count, bool first_side) {
  const TemporaryFolder folder;
  folder.write("discs.geo", discs_between_plates(count));
  return solve_scene(read_scene(folder.write("scene.toml", scene_of(count, first_side))));
}

TEST(RollerBalance, DiscsInARowPassOnTheWholeForceWhicheverSideHasTheMultipliers) {
  for (const int count : {1, 2, 4})
    for (const bool first_side : {true, false}) {
      SCOPED_TRACE(std::to_string(count) + (first_side ? " discs, first sides" : " discs, second sides"));
      const Results r = solved(count, first_side);
      ASSERT_EQ(r.solution.status, SolveStatus::converged);
      ASSERT_EQ(int(r.recovery.contacts.size()), count + 1);
      for (const ContactResults& contact : r.recovery.contacts)
        EXPECT_NEAR(std::abs(contact.force.x()), 3e-6, 3e-6 * 1e-7);
    }
}

// A slab between a base and a punch that comes down, farther than to the slab, less far than both gaps.
Scene pushed_slab(const TemporaryFolder& folder, std::mt19937& random) {
  std::uniform_real_distribution<double> any(0, 1);
  const double below = 1e-3 * (1 + any(random)), above = 1e-2 * (1 + any(random)),
               down = above + below * (0.05 + 0.9 * any(random));
  std::ostringstream geo, toml;
  geo.precision(17);
  geo << "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, -10, 0, 40, 10};\n"
      << "Rectangle(2) = {5, " << below << ", 0, 30, 10}; Rectangle(3) = {10, " << 10 + below + above
      << ", 0, 20, 10};\n"
      << "Physical Surface(\"base\") = {1}; Physical Surface(\"slab\") = {2}; Physical Surface(\"punch\") = {3};\n"
      << "Physical Curve(\"ground\") = {1}; Physical Curve(\"top\") = {3}; Physical Curve(\"foot\") = {5};\n"
      << "Physical Curve(\"side\") = {8}; Physical Curve(\"slab_top\") = {7}; Physical Curve(\"punch_foot\") = {9};\n"
      << "Physical Curve(\"head\") = {11};\n";
  folder.write("slab.geo", geo.str());
  toml << "mesh.file = \"slab.geo\"\nmaterials.steel = { young = 210e3, poisson = 0.3 }\nbodies = { \"*\" = \"steel\" "
          "}\n"
       << "boundary = [{ on = \"ground\", displacement = { x = 0, y = 0 } },\n"
       << "  { on = \"side\", displacement = { x = 0 } }, { on = \"head\", displacement = { x = 0, y = " << -down
       << " } }]\ncontact = [{ between = [\"foot\", \"top\"] }, { between = [\"punch_foot\", \"slab_top\"] }]\n"
       << "accuracy.value = 0.01\n";
  return read_scene(folder.write("slab.toml", toml.str()));
}

TEST(RollerBalance, ABodyThatNothingHoldsBackIsMovedByNoPressure) {
  std::mt19937 random(7);
  for (int k = 0; k < 4; ++k) {
    const TemporaryFolder folder;
    const auto r = solve_to_accuracy(pushed_slab(folder, random));
    ASSERT_TRUE(r) << k;
    EXPECT_TRUE(r->accuracy->reached()) << k << r->accuracy->reason;
    EXPECT_LT(r->recovery.contacts[1].p_max, 1e-15 * 210e3) << k;  // round-off of the modulus
  }
}

}  // namespace
}  // namespace mortise::test
