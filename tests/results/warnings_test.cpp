// What a run says beside its checks: one line for each pair and cause, with the place.
#include "results/warnings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

#include "app/accuracy.hpp"
#include "app/solve_scene.hpp"
#include "results/data_warnings.hpp"
#include "support/patches.hpp"
#include "support/plate_scenes.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

Results solved(const std::string& path, std::vector<Override> overrides) {
  return solve_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/" + path, overrides));
}

int notes_with(const Results& r, const std::string& part) {
  int count = 0;
  for (const std::string& note : r.warnings) count += note.find(part) != std::string::npos;
  return count;
}

std::string all(const Results& r) {
  std::string text;
  for (const std::string& note : r.warnings) text += note + "\n";
  return text;
}

// From a hundredth of an entry on that elements cannot follow.
TEST(DataWarnings, NameEachEntryThatVariesWithinElements) {
  const auto entry = [](const std::string& key, double part) {
    return EntryMisfit{.key = key, .part = part, .at = {1, 2}, .finest = 0.1, .size = 0.5};
  };
  const auto lines = data_warnings({.parts = {}, .entries = {entry("a", 0.011), entry("b", 0.009), entry("c", 0.5)}});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(
      lines[0].rfind("a varies within elements near (1, 2): over a length of 0.1, where they are 0.5 wide; 1.1 %", 0),
      0U)
      << lines[0];
  EXPECT_EQ(lines[1].rfind("c varies", 0), 0U);
}

TEST(Notes, NodesThatFaceNothingAreAsTheyShouldBe) {
  const Results r = solved("geo/punch.toml", {{"contact.multipliers_on", "block_top"}});
  EXPECT_GT(std::ranges::count(r.problem.pairs[0].coupling.row, -1), 10);
  EXPECT_EQ(notes_with(r, "block_top"), 0) << all(r);
}

TEST(Notes, SixNodeTrianglesAreNotToldToBeSixNodeTriangles) {
  for (const auto& [kind, order, said] : {std::tuple{"1", "2", "expected a finer mesh where stresses inside are read"},
                                          {"0", "2", "expected 6-node triangles"},
                                          {"1", "1", "expected quadratic elements"}}) {
    const Results r = solved(
        "geo/rings.toml",
        {{"mesh.parameters.kind", kind}, {"mesh.parameters.order", order}, {"materials.soft.poisson", "0.4999"}});
    EXPECT_GT(notes_with(r, "is nearly incompressible"), 0) << all(r);
    EXPECT_EQ(notes_with(r, "is nearly incompressible"), notes_with(r, said)) << all(r);
  }
}

// Round-off of the coordinates is no reason, be the contact closed, measured or none; a small load is a load.
TEST(Notes, ALoadThatWasForgottenIsTold) {
  const std::string said = "nothing loads the scene: all displacements, stresses and pressures are zero";
  for (const char* scene : {"geo/punch.toml", "geo/parabola_1.toml"})
    for (const char* gap : {"closed", "curve"}) {
      const Results none = solved(scene, {{"boundary.2.pressure", "0"}, {"contact.0.initial_gap", gap}});
      EXPECT_EQ(notes_with(none, said), 1) << all(none);
      EXPECT_EQ(notes_with(none, "coordinates up to"), 0) << all(none);
      EXPECT_EQ(notes_with(solved(scene, {{"boundary.2.pressure", "1e-12"}}), said), 0);
    }
  EXPECT_EQ(notes_with(solved("tests/parts/drawn_interference.toml", {}), said), 0);
}

// ---- Closed and measured gaps ----

TEST(Notes, ClosedSaysWhatItLeavesOut) {
  // A press fit whose interference is drawn: closed drops it, and nothing is pressed.
  const std::string rings = "tests/parts/drawn_interference.toml";
  const Results measured = solved(rings, {});
  EXPECT_GT(measured.recovery.contacts[0].p_max, 1e6);
  EXPECT_EQ(notes_with(measured, "closed"), 0) << all(measured);
  const Results closed = solved(rings, {{"contact.initial_gap", "closed"}});
  EXPECT_EQ(notes_with(closed, "leaves out gaps"), 1) << all(closed);
}

TEST(Notes, ClosedIsNotAdvisedForAClearance) {
  const Results r = solved("tests/parts/pin_in_hole.toml", {});
  EXPECT_EQ(notes_with(r, "closed"), 0) << all(r);
}

// ---- Geometry ----

TEST(Notes, ASplineThatTurnsAtItsEndIsUsed) {
  TemporaryFolder folder;
  // A cosine through points, as users draw it; gmsh gives its ends the slope of a chord.
  std::ofstream(folder.path("a.geo")) << R"(
Macro Side
  first = newp; x = 0; list[] = {};
  For i In {0 : 200}
    x = i / 200; p = newp; Point(p) = {x, 0.1 * Cos(2 * Pi * x), 0}; list[] += p;
  EndFor
  c = newc; Spline(c) = list[];
  p = newp; Point(p) = {0, far, 0}; Point(p + 1) = {1, far, 0};
  l = newc; Line(l) = {list[200], p + 1}; Line(l + 1) = {p + 1, p}; Line(l + 2) = {p, list[0]};
  s = newll; Curve Loop(s) = {c, l, l + 1, l + 2}; Plane Surface(s) = {s};
  Transfinite Curve{c} = n;
Return
far = 1; n = 30;
Call Side;
Physical Surface("upper") = {s}; Physical Curve("above") = {c};
Physical Curve("top") = {l + 1}; Physical Curve("upper_sides") = {l, l + 2};
far = -1; n = 40;
Call Side;
Physical Surface("lower") = {s}; Physical Curve("below") = {c};
Physical Curve("bottom") = {l + 1}; Physical Curve("lower_sides") = {l, l + 2};
)";
  std::ofstream(folder.path("a.toml")) << R"(
mesh.file = "a.geo"
materials.steel = { young = 210e9, poisson = 0.3 }
bodies = { upper = "steel", lower = "steel" }
boundary = [ { on = "bottom", displacement = { x = 0, y = 0 } }, { on = "top", pressure = 1e6 },
             { on = ["upper_sides", "lower_sides"], displacement = { x = 0 } } ]
contact = [ { between = ["above", "below"], condition = "bilateral" } ]
)";
  const Results bent = solve_scene(read_scene(folder.path("a.toml")));
  EXPECT_EQ(notes_with(bent, "is not used"), 0) << all(bent);
  EXPECT_EQ(bent.problem.pairs[0].coupling.gap_max, 0);  // one line; the edges are 5e-4 apart
}

TEST(Notes, ADrawnCurveThatIsNotUsedIsNamedWithTheReason) {
  Mesh mesh = mesh_of({});
  std::ranges::find(mesh.boundaries, "lower_contact", &Boundary::name)->undrawn = "nobody knows it";
  const Results r = solve_scene(uniaxial_scene(), mesh);
  EXPECT_EQ(notes_with(r, "the drawn curve 'lower_contact' is not used, as nobody knows it"), 1) << all(r);
}

TEST(Notes, StraightSidesOfACurvedLineChangeNothing) {
  const std::string pin = "tests/parts/pin_in_hole.toml";
  const Results straight = solved(pin, {{"mesh.parameters.straight", "1"}}), curved = solved(pin, {});
  EXPECT_EQ(notes_with(straight, "contact.0"), notes_with(curved, "contact.0")) << all(straight);
  EXPECT_NEAR(straight.recovery.contacts[0].p_max, curved.recovery.contacts[0].p_max,
              0.01 * curved.recovery.contacts[0].p_max);
}

// ---- Displacements ----

TEST(Notes, AClearanceOfThreePercentOfTheRadiusIsALargeDisplacement) {
  const Results r =
      solved("tests/parts/pin_in_hole.toml", {{"mesh.parameters.clearance", "0.03"}, {"mesh.parameters.drop", "0"}});
  EXPECT_EQ(notes_with(r, "of the contact line's radius"), 1) << all(r);
  const Results small = solved("tests/parts/pin_in_hole.toml", {{"mesh.parameters.clearance", "0.0003"}});
  EXPECT_EQ(notes_with(small, "large displacements"), 0) << all(small);
}

// Rings, one shrunk onto the other by 5 % of the radius, as they are round the axis, whatever their length along it.
TEST(Notes, AnInterferenceOfRingsIsALargeDisplacement) {
  const auto level = [](double y) { return [y](double) { return y; }; };
  for (const double length : {20., 1000.}) {
    Scene s;
    s.path = "rings";
    s.model.plane = Plane::axisymmetric;
    s.materials["rubber"] = {5, 0.3};
    s.bodies = {{"inner", "rubber"}, {"outer", "rubber"}};
    for (const char* face : {"inner_south", "inner_north", "outer_south", "outer_north"})
      s.boundaries.push_back({.key = face, .on = {face}, .what = Displacement{{}, 0}});
    s.contacts = {{.key = "contact.0", .between = {"inner_east", "outer_west"}, .initial_gap = InitialGap::given}};
    s.contacts[0].gap = -5;
    const Results r = solve_scene(s, test::mesh_of({test::block("inner", 8, 3, 50, 100, level(0), level(length)),
                                                    test::block("outer", 8, 4, 100, 150, level(0), level(length))},
                                                   CellKind::quad8));
    EXPECT_EQ(notes_with(r, "move against one another by 5 % of the contact line's radius"), 1) << all(r);
  }
}

// The upper plate slides by 5 % of the length, on a straight line and without a turn.
TEST(Notes, SidesThatSlideAreALargeDisplacement) {
  Scene s = uniaxial_scene();
  s.boundaries[0].on = {"lower_left"};
  s.boundaries.push_back({.key = {}, .on = {"upper_left"}, .what = Displacement{0.04, {}}});
  const Results r = solve_scene(s, mesh_of({}));
  EXPECT_EQ(notes_with(r, "the sides slide along one another by 5 % of the length in contact"), 1) << all(r);
  s.boundaries.back().what = Displacement{0.004, {}};
  EXPECT_EQ(notes_with(solve_scene(s, mesh_of({})), "large displacements"), 0);
}

// A shaft that slides down the flank it is pressed on, by loads drawn at random: what is said of p is what the normals
// of one curve instead of the other's change it by.
TEST(Notes, AContactThatSlidesHasItsPressureShifted) {
  std::mt19937 draw(41);
  for (int k = 0; k < 3; ++k) {
    const double load = std::pow(10, std::uniform_real_distribution(7.5, 8.7)(draw));
    std::array<std::vector<ContactNode>, 2> nodes;
    double said = 0;
    for (const int side : {0, 1}) {
      const auto r = solve_to_accuracy(read_scene(std::string(MORTISE_SOURCE_DIR) + "/tests/parts/v_block.toml",
                                                  {{"accuracy.value", "0.5%"},
                                                   {"body_force.0.force", "[0, -" + std::to_string(load) + "]"},
                                                   {"contact.0.multipliers_on", side == 0 ? "shaft_foot" : "flank"}}));
      ASSERT_TRUE(r && r->accuracy->reached());
      const ContactResults& contact = r->recovery.contacts[0];
      nodes[side] = side == 0 ? contact.multiplier.nodes : contact.opposite.nodes;
      for (const std::string& note : r->warnings)
        if (const auto at = note.find("large displacements"); at != std::string::npos)
          said = std::stod(note.substr(note.find("p may be off by ") + 16)) / 100;
    }
    const auto p = [&](int side, double s) {
      const auto next = std::ranges::upper_bound(nodes[side], s, {}, &ContactNode::s);
      if (next == nodes[side].begin() || next == nodes[side].end()) return 0.;
      const ContactNode &a = *std::prev(next), &b = *next;
      return a.p + (s - a.s) / (b.s - a.s) * (b.p - a.p);
    };
    double off = 0, all_of_it = 0;
    for (double s = 0; s < nodes[0].back().s; s += nodes[0].back().s / 1e5) {
      off += std::pow(p(0, s) - p(1, s), 2);
      all_of_it += std::pow(p(0, s), 2);
    }
    EXPECT_NEAR(std::sqrt(off / all_of_it), said, 0.2 * said) << load;
    EXPECT_GT(said, 0.01) << load;
  }
}

TEST(Notes, ATurnOfTheWholeIsALargeDisplacement) {
  Scene s = uniaxial_scene();
  EXPECT_EQ(notes_with(solve_scene(s, mesh_of({})), "large displacements"), 0);
  // Bottom and top move as a turn of the whole by 9 degrees moves them, and are pressed together.
  const auto turned = [](const std::string& curve, const std::string& y) -> BoundarySpec {
    return {.key = {}, .on = {curve}, .what = Displacement{Field("-0.15 * y", {}), Field(y, {})}};
  };
  s.boundaries = {turned("bottom", "0.15 * x"), turned("top", "0.15 * x - 1e-4")};
  const Results r = solve_scene(s, mesh_of({}));
  EXPECT_EQ(notes_with(r, "the contact line turns and stretches so that"), 1) << all(r);
}

}  // namespace
}  // namespace mortise::test
