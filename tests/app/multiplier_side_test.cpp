// Which curve carries the multipliers on meshes that an accuracy makes.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <numbers>
#include <random>
#include <sstream>

#include "app/accuracy.hpp"
#include "app/solve_scene.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// A roller in a groove of two flat sides that stand `lean` from upright: what is right and left is alike.
Scene roller_in_a_groove(const TemporaryFolder& folder, double lean, double radius, double load, int first_edges) {
  std::ostringstream geo, scene;
  const double up = std::cos(lean), aside = std::sin(lean), y = radius / aside;
  geo << "R = " << radius << "; y = " << y << "; s = " << aside << "; c = " << up << ";\n"
      << R"(
Point(1) = {0, y, 0}; Point(2) = {R, y, 0}; Point(3) = {0, y + R, 0}; Point(4) = {-R, y, 0}; Point(5) = {0, y - R, 0};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Circle(3) = {4, 1, 5}; Circle(4) = {5, 1, 2};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Point(11) = {-40, -20, 0}; Point(12) = {40, -20, 0}; Point(13) = {40, 30 * c, 0}; Point(14) = {30 * s, 30 * c, 0};
Point(15) = {3 * s, 3 * c, 0}; Point(16) = {-3 * s, 3 * c, 0}; Point(17) = {-30 * s, 30 * c, 0}; Point(18) = {-40, 30 * c, 0};
For i In {11:17}
  Line(i) = {i, i + 1};
EndFor
Line(18) = {18, 11};
Curve Loop(2) = {11:18}; Plane Surface(2) = {2};
Physical Surface("roller") = {1}; Physical Surface("block") = {2};
Physical Curve("rim") = {1:4}; Physical Curve("right") = {14}; Physical Curve("left") = {16}; Physical Curve("ground") = {11};)";
  folder.write("groove.geo", geo.str());
  scene << "mesh.file = \"groove.geo\"\nmaterials.steel = { young = 210e3, poisson = 0.3 }\n"
        << "bodies = { \"*\" = \"steel\" }\n"
        << "boundary = [{ on = \"ground\", displacement = { x = 0, y = 0 } }]\n"
        << "body_force = [{ body = \"roller\", force = [0, " << -load << "] }]\n"
        << "contact = [{ between = [\"rim\", \"left\"] }, { between = [\"rim\", \"right\"] }]\n"
        << "accuracy = { value = \"2%\", first_edges = " << first_edges << " }\n";
  return read_scene(folder.write("groove.toml", scene.str()), {});
}

// Where the sides slide along one another p hangs on whose normals count: pairs that are alike have them alike, on each
// mesh.
TEST(MultiplierSide, OfPairsThatAreAlikeIsAlikeOnEachMeshOfAnAccuracy) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> lean(0.5, 1.1), radius(6, 12), load(0.5, 3);
  std::uniform_int_distribution<int> edges(12, 30);
  for (int i = 0; i < 5; ++i) {
    const TemporaryFolder folder;
    const auto r =
        solve_to_accuracy(roller_in_a_groove(folder, lean(random), radius(random), load(random), edges(random)));
    ASSERT_TRUE(r && r->accuracy->reached()) << i;
    for (const ContactPair& pair : r->problem.pairs) EXPECT_EQ(pair.spec.multipliers_on, "rim") << i;
    const auto& contacts = r->recovery.contacts;
    const double largest = largest_entry(contacts[0].pressure);
    EXPECT_NEAR(largest_entry(contacts[1].pressure), largest, 0.01 * largest) << i;
  }
}

// A punch that is flat and rounded at its ends on a wide block: normals that turn faster from where the rounding
// begins make p grow as a logarithm there if the bodies slide. The flat side's do not.
TEST(MultiplierSide, IsTheSmoothOneOfTwo) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> flat(2, 6), round(1, 4), load(500, 3000);
  for (int i = 0; i < 4; ++i) {
    const TemporaryFolder folder;
    std::ostringstream geo, scene;
    const double f = flat(random);
    geo << std::setprecision(17) << "f = " << f << "; r = " << round(random) << ";\n"
        << R"(
Point(1) = {-f - r, r, 0}; Point(2) = {-f, r, 0}; Point(3) = {-f, 0, 0}; Point(4) = {f, 0, 0}; Point(5) = {f, r, 0};
Point(6) = {f + r, r, 0}; Point(7) = {f + r, 15, 0}; Point(8) = {-f - r, 15, 0};
Circle(1) = {1, 2, 3}; Line(2) = {3, 4}; Circle(3) = {4, 5, 6}; Line(4) = {6, 7}; Line(5) = {7, 8}; Line(6) = {8, 1};
Curve Loop(1) = {1:6}; Plane Surface(1) = {1};
Point(11) = {-40, -40, 0}; Point(12) = {40, -40, 0}; Point(13) = {40, 0, 0}; Point(14) = {-40, 0, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(2) = {11:14}; Plane Surface(2) = {2};
Physical Surface("punch") = {1}; Physical Surface("block") = {2}; Physical Curve("foot") = {1:3};
Physical Curve("head") = {5}; Physical Curve("ground") = {11}; Physical Curve("top") = {13};)";
    folder.write("punch.geo", geo.str());
    const std::string between = i % 2 == 0 ? "[\"foot\", \"top\"]" : "[\"top\", \"foot\"]";
    scene << "mesh.file = \"punch.geo\"\nmaterials.steel = { young = 210e3, poisson = 0.3 }\n"
          << "bodies = { \"*\" = \"steel\" }\n"
          << "boundary = [{ on = \"ground\", displacement = { x = 0, y = 0 } },\n"
          << "  { on = \"head\", rigid = { x = 0, rotation = 0, force = [0, " << -load(random) << "] } }]\n"
          << "contact = [{ between = " << between << " }]\naccuracy = { value = \"1%\" }\n";
    const std::filesystem::path path = folder.write("punch.toml", scene.str());
    const auto r = solve_to_accuracy(read_scene(path, {}));
    ASSERT_TRUE(r && r->accuracy->reached()) << i;
    EXPECT_EQ(r->problem.pairs[0].spec.multipliers_on, "top") << i;
    // With the other's normals the bars hold what they make of p where the rounding begins.
    const auto turned = solve_to_accuracy(read_scene(path, {{"contact.0.multipliers_on", "foot"}}));
    ASSERT_TRUE(turned && turned->accuracy->reached()) << i;
    const PressureEstimate& estimate = turned->estimate->pressures[0];
    int joints = 0;
    for (Eigen::Index k = 0; k < estimate.local.least.size(); ++k)
      joints += std::abs(std::abs(estimate.line.position[k].x()) - f) < 1e-9 && estimate.local.least(k) > 0;
    EXPECT_EQ(joints, 2) << i;
  }
}

// A roller with a chamfer, in one curve with its mantle: across the kink normals of the mantle open what the smooth
// track's keep closed. Asked for, they have a bar of the length that holds what they make of it.
TEST(MultiplierSide, IsNotTheOneThatTurnsInContact) {
  for (const double degrees : {5, 15, 45}) {
    const TemporaryFolder folder;
    std::ostringstream geo;
    geo << "a = " << degrees << R"( * Pi / 180;
Point(1) = {0, 0, 0}; Point(2) = {3, 0, 0}; Point(3) = {3 + 0.35 * Cos(a), 0.35 * Sin(a), 0};
Point(4) = {3.4, 6, 0}; Point(5) = {0, 6, 0}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5};
Line(5) = {5, 1}; Curve Loop(1) = {1:5}; Plane Surface(1) = {1};
Point(11) = {0, -10, 0}; Point(12) = {10, -10, 0}; Point(13) = {10, 0, 0}; Point(14) = {0, 0, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(2) = {11:14}; Plane Surface(2) = {2};
Physical Surface("roller") = {1}; Physical Surface("race") = {2}; Physical Curve("mantle") = {1, 2};
Physical Curve("top") = {4}; Physical Curve("middle") = {5, 14}; Physical Curve("track") = {13}; Physical Curve("bed") = {11};)";
    folder.write("roller.geo", geo.str());
    const std::filesystem::path path = folder.write("roller.toml", R"(mesh.file = "roller.geo"
materials.steel = { young = 210e3, poisson = 0.3 }
bodies."*" = "steel"
boundary = [{ on = "middle", displacement = { x = 0 } }, { on = "bed", displacement = { y = 0 } }, { on = "top", pressure = 93 }]
contact = [{ between = ["mantle", "track"] }]
accuracy = { value = "0.1%", of = "half_width" }
)");
    const auto r = solve_to_accuracy(read_scene(path, {}));
    ASSERT_TRUE(r && r->accuracy->reached()) << degrees;
    EXPECT_EQ(r->problem.pairs[0].spec.multipliers_on, "track") << degrees;
    EXPECT_NEAR(r->recovery.contacts[0].length_in_contact, 3, 3e-3) << degrees;
    if (degrees != 15) continue;
    const auto turned =
        solve_to_accuracy(read_scene(path, {{"contact.0.multipliers_on", "mantle"}, {"accuracy.of", "pressure"}}));
    const ContactResults& contact = turned->recovery.contacts[0];
    EXPECT_LE(std::abs(contact.length_in_contact - 3), *contact.length_error + 1e-9);  // it ends at the kink
    EXPECT_LT(*contact.length_error, 0.05);
  }
}

// A punch whose foot and the overhangs beside it are one curve: contact ends at corners beyond which it faces the block
// again, farther away or on steep flanks. On its own side that is at vertices; on the block's the edges see both.
TEST(MultiplierSide, IsThatOnWhichContactEndsAtVertices) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> overhang(0.02, 0.2), height(0.01, 0.15);
  for (int i = 0; i < 4; ++i) {
    const TemporaryFolder folder;
    std::ostringstream geo;
    geo << "o = " << (i == 0 ? 0.2 : overhang(random)) << "; h = " << height(random)
        << "; flank = " << (i < 2 ? "0" : "0.1") << " * h;\n"
        << R"(SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 0.6, 0.2};
Point(11) = {0.2, 0.2, 0}; Point(12) = {0.4, 0.2, 0}; Point(13) = {0.4 + flank, 0.2 + h, 0}; Point(14) = {0.4 + o, 0.2 + h, 0};
Point(15) = {0.4 + o, 0.4, 0}; Point(16) = {0.2 - o, 0.4, 0}; Point(17) = {0.2 - o, 0.2 + h, 0}; Point(18) = {0.2 - flank, 0.2 + h, 0};
For i In {11:17}
  Line(i) = {i, i + 1};
EndFor
Line(18) = {18, 11}; Curve Loop(11) = {11:18}; Plane Surface(11) = {11};
Physical Surface("block") = {1}; Physical Surface("punch") = {11}; Physical Curve("ground") = {1};
Physical Curve("top") = {3}; Physical Curve("under") = {17, 18, 11, 12, 13}; Physical Curve("head") = {15};)";
    folder.write("punch.geo", geo.str());
    const std::string between = i % 2 == 0 ? R"(["top", "under"])" : R"(["under", "top"])";
    const std::filesystem::path path = folder.write("punch.toml", R"(mesh.file = "punch.geo"
materials.steel = { young = 210e9, poisson = 0.3 }
bodies."*" = "steel"
boundary = [{ on = "ground", displacement = { x = 0, y = 0 } }, { on = "head", displacement = { x = 0 } }, { on = "head", pressure = 10e6 }]
contact = [{ between = )" + between + R"( }]
accuracy = { value = "1%" }
)");
    std::vector<double> middle;
    for (const std::string side : {"under", "top"}) {
      const auto r = solve_to_accuracy(read_scene(
          path, side == "top" ? std::vector<Override>{{"contact.0.multipliers_on", side}} : std::vector<Override>{}));
      ASSERT_TRUE(r && r->accuracy->reached()) << side << " " << i;
      if (i < 2) EXPECT_EQ(r->problem.pairs[0].spec.multipliers_on, side) << i;
      const PressureEstimate& estimate = r->estimate->pressures[0];
      ASSERT_EQ(estimate.singular.size(), 2) << side << " " << i;
      for (const SingularPoint& point : estimate.singular) {
        EXPECT_NEAR(std::abs(point.position.x() - 0.3), 0.1, 1e-9);
        EXPECT_LT(point.pressure_exponent, 1);
      }
      middle.push_back(estimate.line.p(estimate.line.nearest({0.3, 0.2})));
    }
    EXPECT_NEAR(middle[0], middle[1], 0.02 * middle[0]) << i;
  }
}

// Racks of leaning teeth, each one curve. Contact of two flanks ends at a tip of either rack, where its curve turns and
// the gap opens at once: within an edge of the other rack.
TEST(MultiplierSide, MayBeEitherOfTwoRacks) {
  const int teeth = 3;
  const double pitch = 12.2, high = 0.38 * pitch, lean = high * std::tan(5 * std::numbers::pi / 180);
  std::ostringstream geo;
  geo << "SetFactory(\"OpenCASCADE\");\n" << std::setprecision(12);
  for (const int rack : {0, 1}) {
    const double out = 0.05 * rack, up = 0.1 * high * rack, base = rack == 0 ? -2 * high : 3 * high;
    std::vector<Vec2> outline{{out, base}, {out, up}};
    for (int i = 0; i < teeth; ++i) {
      const double from = (i + 0.25) * pitch, to = from + pitch / 2;
      outline.insert(outline.end(), {{from - lean / 2 - out, up},
                                     {from + lean / 2 - out, high + up},
                                     {to - lean / 2 + out, high + up},
                                     {to + lean / 2 + out, up}});
    }
    outline.insert(outline.end(), {{teeth * pitch + out, up}, {teeth * pitch + out, base}});
    const int first = 100 * rack + 1, last = first + int(outline.size()) - 1;
    for (int i = first; i <= last; ++i)
      geo << "Point(" << i << ") = {" << outline[i - first].x() << ", " << outline[i - first].y() << ", 0};\n";
    for (int i = first; i <= last; ++i)
      geo << "Line(" << i << ") = {" << i << ", " << (i == last ? first : i + 1) << "};\n";
    geo << "Curve Loop(" << first << ") = {" << first << ":" << last << "}; Plane Surface(" << first << ") = {" << first
        << "};\nPhysical Surface(\"rack_" << rack << "\") = {" << first << "};\nPhysical Curve(\"teeth_" << rack
        << "\") = {" << first + 1 << ":" << last - 2 << "};\nPhysical Curve(\"back_" << rack << "\") = {" << last
        << "};\n";
  }
  const TemporaryFolder folder;
  folder.write("racks.geo", geo.str());
  const std::filesystem::path path = folder.write("racks.toml", R"(mesh.file = "racks.geo"
materials.steel = { young = 210e3, poisson = 0.3 }
bodies."*" = "steel"
boundary = [{ on = "back_0", displacement = { x = 0, y = 0 } }, { on = "back_1", rigid = { y = 0, rotation = 0, force = [375, 0] } }]
contact = [{ between = ["teeth_0", "teeth_1"] }]
accuracy = { value = "2%" }
)");
  std::vector<double> lengths;
  for (const char* side : {"teeth_0", "teeth_1"}) {
    const auto r = solve_to_accuracy(read_scene(path, {{"contact.0.multipliers_on", side}}));
    ASSERT_TRUE(r && r->accuracy->reached()) << side;
    lengths.push_back(r->recovery.contacts[0].length_in_contact);
  }
  EXPECT_NEAR(lengths[0], lengths[1], 0.01 * lengths[0]);
}

// Whatever a finer mesh says of edges and of how much of a curve faces the other.
TEST(MultiplierSide, StaysThatOfAnEarlierMesh) {
  const Scene scene = read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/hertz.toml", {});
  Mesh mesh = scene_mesh(scene);
  const auto side = [&](std::vector<KnownPair> known) {
    mesh.known_pairs = std::move(known);
    return prepare(scene, mesh).pairs[0].spec.multipliers_on;
  };
  EXPECT_EQ(side({{{"block_top", "cylinder_foot"}, true}}), "block_top");
  EXPECT_EQ(side({{{"cylinder_foot", "block_top"}, true}}), "cylinder_foot");
}

}  // namespace
}  // namespace mortise::test
