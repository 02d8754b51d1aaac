// Curves that a .geo has gmsh mesh as one.
#include "gmsh/compound_curves.hpp"

#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "app/solve_scene.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// Of blocks.geo in the folder; `sides`: the [[contact]] entries.
Scene scene_of(const TemporaryFolder& folder, const std::string& sides) {
  return read_scene(folder.write("blocks.toml", R"(
mesh.file = "blocks.geo"
materials.steel = { young = 210e3, poisson = 0.3 }
bodies = { low = "steel", up = "steel" }
boundary = [
  { on = "ground", displacement = { y = 0 } },
  { on = "left", displacement = { x = 0 } },
  { on = "top", pressure = 10 },
]
contact = [)" + sides + "]\n"));
}

// A block on a block, under 10 MPa. The upper one's foot is of pieces, of which some are one compound; `names`: the
// physical curves of the foot's pieces.
Scene with_compound(const TemporaryFolder& folder, const std::vector<double>& cuts, int first, int last,
                    const std::string& names, const std::string& sides) {
  std::ostringstream geo, loop, compound;
  geo << R"(Mesh.ElementOrder = 2; Mesh.MeshSizeMax = 0.4;
Point(1) = {0, -2, 0}; Point(2) = {4, -2, 0}; Point(3) = {4, 0, 0}; Point(4) = {0, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1 ... 4}; Plane Surface(1) = {1};
Point(5) = {4, 2, 0}; Point(6) = {0, 2, 0}; Point(10) = {0, 0, 0};
)";
  const int pieces = int(cuts.size()) + 1;
  for (int i = 1; i <= pieces; ++i) {
    geo << "Point(" << 10 + i << ") = {" << (i < pieces ? cuts[i - 1] : 4) << ", 0, 0}; Line(" << 10 + i << ") = {"
        << 9 + i << ", " << 10 + i << "};\n";
    loop << 10 + i << ", ";
    if (i >= first && i <= last) compound << (i > first ? ", " : "") << 10 + i;
  }
  geo << "Line(5) = {" << 10 + pieces << ", 5}; Line(6) = {5, 6}; Line(7) = {6, 10};\nCurve Loop(2) = {" << loop.str()
      << "5, 6, 7}; Plane Surface(2) = {2};\nCompound Curve {" << compound.str() << "};\n"
      << R"(Physical Surface("low") = {1}; Physical Surface("up") = {2};
Physical Curve("ground") = {1}; Physical Curve("track") = {3}; Physical Curve("top") = {6}; Physical Curve("left") = {4, 7};
)" << names;
  folder.write("blocks.geo", geo.str());
  return scene_of(folder, sides);
}

TEST(CompoundCurves, OfAnyPiecesOfAFootCarryItsPressure) {
  const TemporaryFolder folder;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int variant = 0; variant < 6; ++variant) {
    const int pieces = 2 + variant % 3, first = 1 + int(unit(random) * (pieces - 1)),
              last = first + 1 + int(unit(random) * (pieces - first));
    std::vector<double> cuts;
    for (int i = 1; i < pieces; ++i) cuts.push_back(4. * (i + 0.8 * (unit(random) - 0.5)) / pieces);
    std::string names = "Physical Curve(\"foot\") = {11 ... " + std::to_string(10 + pieces) + "};\n";
    SCOPED_TRACE(names + std::to_string(first) + " to " + std::to_string(last));
    const Results r =
        solve_scene(with_compound(folder, cuts, first, last, names, R"({ between = ["foot", "track"] })"));
    EXPECT_EQ(r.status, Status::solved);
    EXPECT_NEAR(r.recovery.contacts[0].length, 4, 1e-9);
    EXPECT_NEAR(r.recovery.contacts[0].p_min, 10, 1e-6);
    EXPECT_NEAR(r.recovery.contacts[0].p_max, 10, 1e-6);
  }
}

TEST(CompoundCurves, MayHaveSeveralNames) {
  const TemporaryFolder folder;
  const Results r =
      solve_scene(with_compound(folder, {2.5}, 1, 2, "Physical Curve(\"a\") = {11}; Physical Curve(\"b\") = {12};\n",
                                R"({ between = ["a", "track"] }, { between = ["b", "track"] })"));
  EXPECT_EQ(r.status, Status::solved);
  EXPECT_NEAR(r.recovery.contacts[0].length, 2.5, 1e-9);
  EXPECT_NEAR(r.recovery.contacts[1].length, 1.5, 1e-9);
}

// A foot of two pieces of a body of two surfaces that are compound, too: it is meshed from the compound curve.
Scene with_compound_surface(const TemporaryFolder& folder, const std::string& names, const std::string& sides) {
  folder.write("blocks.geo", R"(Mesh.MeshSizeMax = 0.4;
Point(1) = {0, -2, 0}; Point(2) = {4, -2, 0}; Point(3) = {4, 0, 0}; Point(4) = {0, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1 ... 4}; Plane Surface(1) = {1};
Point(5) = {0, 0, 0}; Point(6) = {1.7, 0, 0}; Point(7) = {4, 0, 0}; Point(8) = {4, 2, 0}; Point(9) = {1.7, 2, 0};
Point(10) = {0, 2, 0}; Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 9}; Line(9) = {9, 10};
Line(10) = {10, 5}; Line(11) = {6, 9};
Curve Loop(2) = {5, 11, 9, 10}; Plane Surface(2) = {2}; Curve Loop(3) = {6, 7, 8, -11}; Plane Surface(3) = {3};
Compound Curve {5, 6}; Compound Surface {2, 3};
Physical Surface("low") = {1}; Physical Surface("up") = {2, 3};
Physical Curve("ground") = {1}; Physical Curve("track") = {3}; Physical Curve("top") = {8, 9}; Physical Curve("left") = {4, 10};
)" + names);
  return scene_of(folder, sides);
}

TEST(CompoundCurves, OfCompoundSurfacesCarryTheirPressure) {
  const TemporaryFolder folder;
  const Results r = solve_scene(
      with_compound_surface(folder, "Physical Curve(\"foot\") = {5, 6};\n", R"({ between = ["foot", "track"] })"));
  EXPECT_EQ(r.status, Status::solved);
  EXPECT_NEAR(r.recovery.contacts[0].length, 4, 1e-9);
  EXPECT_NEAR(r.recovery.contacts[0].p_min, 10, 1e-6);
  EXPECT_NEAR(r.recovery.contacts[0].p_max, 10, 1e-6);
}

TEST(CompoundCurves, OfCompoundSurfacesWithSeveralNamesAreRefused) {
  const TemporaryFolder folder;
  const std::string text = message_of([&] {
    solve_scene(with_compound_surface(folder, "Physical Curve(\"a\") = {5}; Physical Curve(\"b\") = {6};\n",
                                      R"({ between = ["a", "track"] }, { between = ["b", "track"] })"));
  });
  expect_contains(text, "blocks.geo: Compound Curve with the curve ");
  expect_contains(text, ": gmsh has one mesh of all its curves, in physical curve '");
  expect_contains(text, "; expected curves with the same names, or none that are compound");
}

}  // namespace
}  // namespace mortise::test
