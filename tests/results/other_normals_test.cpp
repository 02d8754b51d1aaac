// What the normals of the opposite sides would make of p.
#include "results/other_normals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include "app/solve_scene.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// Half of a wedge that is pushed into a slot which leans by `apart` more, radians, from their lower end on.
Results wedge(double lean, double apart, const std::string& push, const std::string& side,
              const std::vector<Override>& overrides = {}) {
  const TemporaryFolder folder;
  std::ostringstream geo, toml;
  geo.precision(17);
  geo << "t = " << std::tan(lean) << "; s = " << std::tan(lean + apart) << R"(;
Point(1) = {0, 0, 0}; Point(2) = {3, 0, 0}; Point(3) = {3 + 12 * t, 12, 0}; Point(4) = {0, 12, 0};
Point(11) = {3, 0, 0}; Point(12) = {3, -2, 0}; Point(13) = {20, -2, 0}; Point(14) = {20, 10, 0}; Point(15) = {3 + 10 * s, 10, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 15}; Line(15) = {15, 11};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1}; Curve Loop(2) = {11:15}; Plane Surface(2) = {2};
MeshSize{ : } = 0.7; Mesh.ElementOrder = 2;
Physical Surface("wedge") = {1}; Physical Surface("block") = {2}; Physical Curve("flank") = {2};
Physical Curve("slot") = {15}; Physical Curve("middle") = {4}; Physical Curve("top") = {3}; Physical Curve("far") = {13};
)";
  folder.write("wedge.geo", geo.str());
  toml.precision(17);
  toml << R"(mesh.file = "wedge.geo"
materials.soft = { young = 1000, poisson = 0.3 }
bodies."*" = "soft"
boundary = [{ on = "middle", displacement = { x = 0 } }, { on = "far", displacement = { x = 0, y = 0 } }, { on = "top", )"
       << push << R"( }]
contact = [{ between = ["flank", "slot"], multipliers_on = ")"
       << side << "\" }]\n";
  return solve_scene(read_scene(folder.write("wedge.toml", toml.str()), overrides));
}

double force(const Results& r) { return r.recovery.contacts[0].force.norm(); }

TEST(OtherNormals, MakeOfPWhatMultipliersOnTheOtherSideDo) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> degrees(5, 20), apart(1e-3, 4e-3);
  for (int i = 0; i < 4; ++i) {
    const double lean = std::numbers::pi / 180 * degrees(random), by = apart(random);
    SCOPED_TRACE(lean);
    for (const std::string push : {"pressure = 20", "displacement = { y = -1 }"}) {
      SCOPED_TRACE(push);
      const Results flank = wedge(lean, by, push, "flank"), slot = wedge(lean, by, push, "slot");
      const double change = std::abs(force(slot) / force(flank) - 1);
      EXPECT_GT(change, by);
      for (const Results* r : {&flank, &slot}) {
        const auto other = other_normals(*r)[0];
        ASSERT_TRUE(other);
        EXPECT_NEAR(other->angle, by, 0.01 * by);
        EXPECT_NEAR(other->part, change, 0.1 * change);  // of which the square is a twentieth
      }
    }
  }
}

TEST(OtherNormals, OfFacetsAndOfFacesThatGiveWayAreNone) {
  for (const Override& change : {Override{"method.normals", "edges"}, Override{"contact.0.stiffness", "1e4"}})
    EXPECT_FALSE(other_normals(wedge(0.2, 3e-3, "pressure = 20", "flank", {change}))[0]) << change.key;
}

TEST(OtherNormals, OfLinesThatAreOneChangeNothing) {
  EXPECT_FALSE(other_normals(wedge(0.2, 0, "pressure = 20", "flank"))[0]);
}

// Those of a coarse mesh differ at all points, one way and the other.
TEST(OtherNormals, OfRollersAgreeBetweenThePoints) {
  const Results r = solve_scene(
      read_scene(MORTISE_SOURCE_DIR "/geo/rollers.toml", {{"mesh.parameters", "{ rollers = 6, fine = 0.1 }"}}));
  for (const auto& other : other_normals(r)) EXPECT_FALSE(other);
}

}  // namespace
}  // namespace mortise::test
