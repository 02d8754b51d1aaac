// What the audit finds before and after the solve, and that it is silent on scenes that are right.
#include "problem/audit.hpp"

#include <gtest/gtest.h>

#include "support/audited_scenes.hpp"
#include "support/messages.hpp"
#include "support/plate_scenes.hpp"

namespace mortise::test {
namespace {

// ---- Scenes that are right ----

class RightScenes : public testing::TestWithParam<const char*> {};

TEST_P(RightScenes, AreSilentBeforeAndAfter) {
  const Scene scene = read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/" + GetParam() + ".toml");
  EXPECT_EQ(before(scene), "");
  EXPECT_EQ(after(scene), "");
}

TEST_P(RightScenes, AreSilentOnLinearTriangles) {
  const Scene scene = read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/" + GetParam() + ".toml",
                                 {{"mesh.parameters.order", "1"}, {"mesh.parameters.kind", "1"}});
  EXPECT_EQ(before(scene), "");
  EXPECT_EQ(after(scene), "");
}

INSTANTIATE_TEST_SUITE_P(All, RightScenes,
                         testing::Values("patch_flat", "patch_inclined", "stack", "tent_a", "tent_b", "tent_c",
                                         "circle", "parabola_1", "parabola_2", "cosine", "rings", "shrink_fit",
                                         "gap_close", "lift_off", "punch", "hertz", "hertz_nafems"),
                         [](const auto& name) { return std::string(name.param); });

// Of one material they may have been joined by mistake; once it is said, whatever the solve shows. Of two they are
// meant.
TEST(Audit, NamesBodiesOfOneMaterialThatShareNodes) {
  const TemporaryFolder folder;
  const std::string load = held("left") + boundary("top", "traction = [0, -10]");
  const auto joined = [&](const std::string& rest) {
    return drawn(folder,
                 "Rectangle(1) = {0, 0, 0, 4, 1}; Rectangle(2) = {0, 1, 0, 4, 1};"
                 "BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; }"
                 "Physical Surface(\"a\") = {1}; Physical Surface(\"b\") = {2};"
                 "l() = Curve In BoundingBox{-0.1, -0.1, -1, 0.1, 2.1, 1}; Physical Curve(\"left\") = {l()};"
                 "t() = Curve In BoundingBox{-0.1, 1.9, -1, 4.1, 2.1, 1}; Physical Curve(\"top\") = {t()};",
                 {"a"}, rest + load);
  };
  const Scene one = joined("b = \"steel\"\n");
  EXPECT_EQ(lines_of(before(one)), 1) << before(one);
  expect_contains(before(one), "bodies 'a' and 'b' share 41 nodes near (");
  expect_contains(before(one), "they are one piece there; contact between them needs nodes of their own");
  EXPECT_EQ(after(one), "");
  EXPECT_EQ(before(joined("b = \"brass\"\n[materials.brass]\nyoung = 100e3\npoisson = 0.3\n")), "");
}

TEST(Audit, IsSilentOnSidesAcrossASlitAndOnBodiesFarApart) {
  for (const std::string gap : {"0.02", "0.5"}) {
    const TemporaryFolder folder;
    const Scene scene = drawn(folder, rectangles({"0, 0, 0, 2, 1", "2 + " + gap + ", 0, 0, 2, 1"}), {"b1", "b2"},
                              held("down1") + held("down2") + boundary("up1", "pressure = 10"));
    EXPECT_EQ(before(scene), "") << gap;
    EXPECT_EQ(after(scene), "") << gap;
  }
}

// An interference along a pair is a press fit, on straight sides that run on past one another too.
TEST(Audit, IsSilentOnAnInterferenceAlongAPair) {
  for (const std::string depth : {"0.001", "0.02", "0.1"})
    for (const std::string x : {"0", "0.5"}) {
      const TemporaryFolder folder;
      const Scene scene = drawn(folder, rectangles({"0, 0, 0, 4, 1", x + ", 1 - " + depth + ", 0, 3, 1"}), {"b1", "b2"},
                                held("down1") + held("up2") + pair("up1", "down2"));
      EXPECT_EQ(before(scene), "") << depth << " " << x;
    }
}

// ---- Boundaries that meet without a pair ----

const char* const block_in_an_L =
    "Point(1) = {0, 0, 0}; Point(2) = {5, 0, 0}; Point(3) = {5, 1, 0}; Point(4) = {1, 1, 0}; Point(5) = {1, 5, 0};"
    "Point(6) = {0, 5, 0}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6};"
    "Line(6) = {6, 1}; Curve Loop(1) = {1:6}; Plane Surface(1) = {1}; Rectangle(2) = {1, 1, 0, 2, 2};"
    "b() = Boundary{ Surface{2}; }; Physical Surface(\"L\") = {1}; Physical Surface(\"block\") = {2};"
    "Physical Curve(\"ground\") = {1, 6}; Physical Curve(\"floor\") = {3}; Physical Curve(\"wall\") = {4};"
    "Physical Curve(\"down\") = {b(0)}; Physical Curve(\"top\") = {b(2)}; Physical Curve(\"side\") = {b(3)};";

TEST(Audit, NamesBoundariesThatMeetWithoutAPair) {
  const TemporaryFolder folder;
  const std::string load = held("ground") + boundary("top", "traction = [-1, -10]");
  const Scene all = drawn(folder, block_in_an_L, {"L", "block"}, load + pair("down", "floor") + pair("side", "wall"));
  EXPECT_EQ(before(all), "");
  EXPECT_EQ(after(all), "");
  const Scene one = drawn(folder, block_in_an_L, {"L", "block"},
                          load + boundary("top", "displacement = { x = 0 }") + pair("down", "floor"));
  const std::string lines = before(one);
  EXPECT_EQ(lines_of(lines), 1) << lines;
  expect_contains(lines, "bodies 'L' and 'block' meet near (1, 2");
  expect_contains(lines, "over a length of 2");
  expect_contains(lines, "[[contact]] between = [\"wall\", \"side\"]");
}

TEST(Audit, NamesEachPairOfCurvesThatMeets) {
  const TemporaryFolder folder;
  const Scene none = drawn(folder, block_in_an_L, {"L", "block"},
                           held("ground") + boundary("top", "displacement = { x = 0, y = -0.01 }"));
  const std::string lines = before(none);
  EXPECT_EQ(lines_of(lines), 1) << lines;
  expect_contains(lines, "over a length of 2 ('floor', 'down') and near (");
  expect_contains(lines, "between = [\"floor\", \"down\"] and write [[contact]] between = [\"wall\", \"side\"]");
}

const std::string two_plates =
    "Rectangle(1) = {0, 0, 0, 4, 1}; Rectangle(2) = {0, 1, 0, 4, 1}; a() = Boundary{ Surface{1}; };"
    "b() = Boundary{ Surface{2}; }; Physical Surface(\"a\") = {1}; Physical Surface(\"b\") = {2};"
    "Physical Curve(\"ground\") = {a(0)}; Physical Curve(\"top\") = {b(2)};";

// A name that both bodies have is no contact curve.
TEST(Audit, AdvisesNoNameOfSeveralBodies) {
  const TemporaryFolder folder;
  const Scene scene = drawn(folder, two_plates + "Physical Curve(\"joint\") = {a(2), b(0)};", {"a", "b"},
                            held("ground") + boundary("top", "displacement = { x = 0, y = -0.01 }"));
  expect_contains(before(scene),
                  "name the boundaries there as physical curves and write [[contact]] between = [..., ...]");
}

TEST(Audit, EndsTheErrorOfABodyThatNothingHolds) {
  const TemporaryFolder folder;
  const Scene scene = drawn(folder, rectangles({"0, 0, 0, 4, 1", "1, 1, 0, 2, 1"}), {"b1", "b2"},
                            held("down1") + boundary("up2", "pressure = 10"));
  const std::string message = message_of([&] { check_scene(scene); });
  expect_contains(message, "nothing holds body 'b2'");
  expect_contains(message, "[[contact]] between = [\"up1\", \"down2\"]");
}

TEST(Audit, SaysWhereNoCurveHasAName) {
  const TemporaryFolder folder;
  const Scene scene =
      drawn(folder, two_plates, {"a", "b"}, held("ground") + boundary("top", "displacement = { x = 0, y = -0.01 }"));
  expect_contains(before(scene), "(an unnamed boundary of 'a', an unnamed boundary of 'b')");
  const std::string crossing = after(scene);
  EXPECT_EQ(lines_of(crossing), 1) << crossing;
  expect_contains(crossing, "bodies 'a' and 'b' pass through one another by 0.01");
}

TEST(Audit, FindsTwoPiecesOfOneBodyThatAreNotJoined) {
  const TemporaryFolder folder;
  const Scene scene =
      drawn(folder,
            "Rectangle(1) = {0, 0, 0, 4, 1}; Rectangle(2) = {0, 1, 0, 4, 1}; a() = Boundary{ Surface{1}; };"
            "b() = Boundary{ Surface{2}; }; Physical Surface(\"a\") = {1, 2};"
            "Physical Curve(\"left\") = {a(3), b(3)};",
            {"a"}, held("left"));
  const std::string lines = before(scene);
  EXPECT_EQ(lines_of(lines), 1) << lines;
  expect_contains(lines, "two pieces of body 'a' meet");
  expect_contains(lines, "over a length of 4");
}

// A roller in a V whose right flank is in a pair, and the left one is not.
TEST(Audit, FindsACurvedBodyThatTouchesAtAPoint) {
  const TemporaryFolder folder;
  const Scene scene = drawn(
      folder,
      "Point(1) = {-2, -2, 0}; Point(2) = {2, -2, 0}; Point(3) = {2, 1, 0}; Point(4) = {1.5, 1, 0};"
      "Point(5) = {0, -0.5, 0}; Point(6) = {-1.5, 1, 0}; Point(7) = {-2, 1, 0}; Line(1) = {1, 2}; Line(2) = {2, 3};"
      "Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 1};"
      "Curve Loop(1) = {1:7}; Plane Surface(1) = {1}; Disk(2) = {0, 0.70710678, 0, 0.85355339};"
      "Physical Surface(\"block\") = {1}; Physical Surface(\"roller\") = {2}; Physical Curve(\"ground\") = {1};"
      "Physical Curve(\"right_flank\") = {4}; Physical Curve(\"left_flank\") = {5};"
      "r() = Boundary{ Surface{2}; }; Physical Curve(\"round\") = {r()};",
      {"block", "roller"},
      held("ground") + boundary("round", "displacement = { x = 0 }") + pair("round", "right_flank") +
          "[[body_force]]\nbody = \"roller\"\nforce = [0, -10]\n");
  const std::string lines = before(scene);
  EXPECT_EQ(lines_of(lines), 1) << lines;
  expect_contains(lines, "\"left_flank\"");
  expect_contains(lines, "\"round\"");
  expect_contains(after(scene), "bodies 'block' and 'roller' pass through one another");
}

// A gap that is not as drawn: the bodies' corners come out of one another's sides, which says nothing; without the pair
// it says so.
TEST(Audit, LeavesBodiesInOneAnotherThatAPairKeepsApartByItsOwnGap) {
  const TemporaryFolder folder;
  for (const double turn : {-0.02, 0., 0.01}) {
    const auto lines = [&](const std::string& contact) {
      return after(drawn(
          folder,
          "Mesh.MeshSizeMax = 0.04; Rectangle(1) = {0, 0, 0, 4, 1}; Rectangle(2) = {0, 1, 0, 4, 1}; a() = Boundary{ "
          "Surface{1}; };"
          "b() = Boundary{ Surface{2}; }; Physical Surface(\"a\") = {1}; Physical Surface(\"b\") = {2};"
          "Physical Curve(\"ground\") = {a(0)}; Physical Curve(\"a_top\") = {a(2)};"
          "Physical Curve(\"a_side\") = {a(3)}; Physical Curve(\"b_foot\") = {b(0)};"
          "Physical Curve(\"top\") = {b(2)};",
          {"a", "b"},
          held("ground") +
              boundary("top", "rigid = { x = -0.01, rotation = " + std::to_string(turn) + ", y = -0.11 }") + contact));
    };
    EXPECT_EQ(lines(pair("a_top", "b_foot") + "initial_gap = 0.1\n").find("pass through"), std::string::npos) << turn;
    expect_contains(lines(""), "pass through one another by 0.1");
  }
}

// Half a roller on half a block: near the line of symmetry the side of the block that is on it is nearer than its top.
TEST(Audit, LeavesWhatIsDeepInOneAnotherOnALineOfSymmetry) {
  const TemporaryFolder folder;
  for (const char* keys : {"clearance = 0.3\n", "clearance = 1\n", "stiffness = 12\n"})
    EXPECT_EQ(
        after(drawn(folder,
                    "Point(1) = {0, 0, 0}; Point(2) = {20, 20, 0}; Point(3) = {0, 20, 0}; Circle(1) = {1, 3, 2};"
                    "Line(2) = {2, 3}; Line(3) = {3, 1}; Curve Loop(1) = {1:3}; Plane Surface(1) = {1};"
                    "Point(4) = {0, -30, 0}; Point(5) = {40, -30, 0}; Point(6) = {40, 0, 0}; Point(7) = {0, 0, 0};"
                    "Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 4};"
                    "Curve Loop(2) = {4:7}; Plane Surface(2) = {2}; Physical Surface(\"roller\") = {1};"
                    "Physical Surface(\"block\") = {2}; Physical Curve(\"tread\") = {1};"
                    "Physical Curve(\"head\") = {2}; Physical Curve(\"ground\") = {4};"
                    "Physical Curve(\"top\") = {6}; Physical Curve(\"middle\") = {3, 7};"
                    "MeshSize{1, 7} = 0.15; MeshSize{2:6} = 4;",
                    {"roller", "block"},
                    boundary("middle", "displacement = { x = 0 }") + boundary("ground", "displacement = { y = 0 }") +
                        boundary("head", "pressure = 10") + pair("tread", "top") + keys))
            .find("pass through"),
        std::string::npos)
        << keys;
}

// ---- Bodies drawn over one another ----

TEST(Audit, RefusesBodiesDrawnOverOneAnother) {
  for (const auto& [geo, what] : std::vector<std::pair<std::string, std::string>>{
           {rectangles({"0, 0, 0, 4, 4", "1, 1, 0, 1, 1"}), "a hole that was not cut"},
           {rectangles({"0, 0, 0, 4, 1", "0, 0, 0, 4, 1"}), "the same place twice"},
           {rectangles({"0, 2, 0, 8, 1", "4, 0, 0, 1, 8"}), "a cross"}}) {
    const TemporaryFolder folder;
    const Scene scene = drawn(folder, geo, {"b1", "b2"}, held("left1") + held("down2"));
    const std::string message = message_of([&] { check_scene(scene); });
    expect_contains(message, "bodies 'b1' and 'b2' are drawn over one another");
    expect_contains(message, " near (");
    expect_contains(message_of([&] { solve_scene(scene); }), "drawn over one another");
  }
}

// A pair presses an interference apart, but no far sides: then nothing would hold the body above.
TEST(Audit, RefusesBodiesDrawnFarIntoOneAnotherInAPairToo) {
  struct Case {
    std::string geo, depth;
  };
  for (const auto& [geo, depth] : {Case{rectangles({"-2, -2, 0, 4, 2", "-0.5, -0.5, 0, 1, 1"}), "0.5"},  // half a punch
                                   Case{rectangles({"-2, -2, 0, 4, 2", "-0.5, -0.3, 0, 1, 1"}), "0.3"},
                                   Case{rectangles({"0, 0, 0, 1, 1", "0, 0.6, 0, 1, 1"}), "0.4"},  // two halves
                                   Case{rectangles({"0, 0, 0, 1, 1", "0.25, 0.5, 0, 1, 1"}), "0.5"}}) {
    const TemporaryFolder folder;
    const Scene scene = drawn(folder, geo, {"b1", "b2"},
                              held("down1") + boundary("left2", "displacement = { x = 0 }") +
                                  boundary("up2", "pressure = 10") + pair("up1", "down2"));
    const std::string message = message_of([&] { check_scene(scene); });
    expect_contains(message, "bodies 'b1' and 'b2' are drawn over one another by " + depth.substr(0, 2));
    expect_contains(message, " near (");
  }
}

// A wall of 0.05 on a ring of radius 1 takes an interference of half of it: 2 % round the ring.
TEST(Audit, IsSilentOnAThinLinerPressedIn) {
  const TemporaryFolder folder;
  const Scene scene = drawn(folder,
                            "Disk(1) = {0, 0, 0, 1.02}; Disk(2) = {0, 0, 0, 0.97}; BooleanDifference(3) = { "
                            "Surface{1}; Delete; }{ Surface{2}; Delete; };"
                            "Disk(4) = {0, 0, 0, 2}; Disk(5) = {0, 0, 0, 1}; BooleanDifference(6) = { Surface{4}; "
                            "Delete; }{ Surface{5}; Delete; };"
                            "l() = Boundary{ Surface{3}; }; h() = Boundary{ Surface{6}; };"
                            "Physical Surface(\"liner\") = {3}; Physical Surface(\"housing\") = {6};"
                            "Physical Curve(\"out\") = {l(0)}; Physical Curve(\"in\") = {l(1)};"
                            "Physical Curve(\"rim\") = {h(0)}; Physical Curve(\"bore\") = {h(1)};",
                            {"liner", "housing"}, held("rim") + pair("out", "bore"));
  EXPECT_EQ(before(scene).find("drawn"), std::string::npos) << before(scene);
}

// Blocks that sink into one another as drawn and are moved out as a whole; what is pressed apart is an interference.
TEST(Audit, NamesADrawnOverlapThatNoBodyDeformsBy) {
  const auto lines = [](const std::string& above) {
    const TemporaryFolder folder;
    return after(drawn(
        folder, rectangles({"0, 0, 0, 4, 1", "1, 0.99, 0, 2, 1"}), {"b1", "b2"},
        held("down1") + boundary("left2", "displacement = { x = 0 }") + boundary("up2", above) + pair("up1", "down2")));
  };
  const std::string free = lines("pressure = 1");
  expect_contains(free, "'up1' and 'down2' are drawn into one another by 0.01 near (");
  const std::string_view times = " times the bodies' deformation";
  expect_contains(free, times.data());
  const std::size_t end = free.find(times), start = free.rfind(", ", end) + 2;
  const double many = std::stod(free.substr(start, end - start));  // a pressure of 1e3 deforms them by 0.007
  EXPECT_GT(many, 1e3);
  EXPECT_LT(many, 2e3);
  EXPECT_EQ(lines("displacement = { y = 0 }"), "");
  EXPECT_EQ(lines("pressure = 1e3"), "");  // deforms them by 0.007
}

TEST(Audit, SaysWhereBothCurvesAreOfOneBody) {
  const TemporaryFolder folder;
  const std::string held_up =
      held("down1") + boundary("left2", "displacement = { x = 0 }") + boundary("up2", "pressure = 1");
  std::string geo = rectangles({"0, 0, 0, 4, 1", "1, 1, 0, 2, 1"});
  const std::string twice = "Physical Surface(\"b1\") = {1};\n";
  geo.replace(geo.find(twice), twice.size(), "Physical Surface(\"all\") = {1, 2};\n");
  const std::string second = "Physical Surface(\"b2\") = {2};\n";
  geo.replace(geo.find(second), second.size(), "");
  const Scene pieces = drawn(folder, geo, {"all"}, held_up + pair("up1", "down2"));
  expect_contains(message_of([&] { check_scene(pieces); }),
                  "'up1' and 'down2' are curves of two pieces of one body, 'all'; expected two bodies");
  const Scene apart = drawn(folder, rectangles({"0, 0, 0, 4, 1"}), {"b1"}, held("down1") + pair("left1", "right1"));
  expect_contains(message_of([&] { check_scene(apart); }), "both are curves of body 'b1'");
  const Scene ring =
      drawn(folder,
            "Rectangle(1) = {0, 0, 0, 4, 2}; Rectangle(2) = {1, 0.99, 0, 3, 0.02};"
            "BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };"
            "Physical Surface(\"clamp\") = {3};"
            "d() = Curve In BoundingBox{0.9, 0.98, -1, 4.1, 0.995, 1}; Physical Curve(\"under\") = {d()};"
            "u() = Curve In BoundingBox{0.9, 1.005, -1, 4.1, 1.02, 1}; Physical Curve(\"over\") = {u()};"
            "l() = Curve In BoundingBox{-0.1, -0.1, -1, 0.1, 2.1, 1}; Physical Curve(\"left\") = {l()};",
            {"clamp"}, held("left") + pair("under", "over"));
  expect_contains(before(ring), "are both curves of body 'clamp', which is in contact with itself there");
}

TEST(Audit, WarnsOfAThinInterferenceWithoutAPair) {
  const TemporaryFolder folder;
  const Scene scene =
      drawn(folder, rectangles({"0, 0, 0, 4, 1", "0.5, 0.98, 0, 3, 1"}), {"b1", "b2"}, held("down1") + held("up2"));
  const std::string lines = before(scene);
  EXPECT_EQ(lines_of(lines), 1) << lines;
  expect_contains(lines, "bodies 'b1' and 'b2' are drawn into one another by 0.02");
  expect_contains(lines, "[\"up1\", \"down2\"]");
}

TEST(Audit, RefusesElementsListedTwice) {
  Mesh mesh = mesh_of({});
  const Cell inside = mesh.cells[10];  // of the middle row, no side of it is on a named boundary
  mesh.cells.insert(mesh.cells.begin(), inside);
  expect_contains(message_of([&] { solve_scene(uniaxial_scene(), mesh); }), "one over the other, near (");
}

// ---- Contact at the end of a curve ----

// Two half cylinders of radius 1 that touch at the origin, named up to the angle `a`.
std::string cylinders(const std::string& a) {
  return "a = " + a +
         "; Point(1) = {0, 0, 0}; Point(2) = {Sin(a), 1 - Cos(a), 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};"
         "Circle(1) = {1, 4, 2}; Circle(2) = {2, 4, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4};"
         "Plane Surface(1) = {1}; Point(11) = {0, 0, 0}; Point(12) = {Sin(a), Cos(a) - 1, 0}; Point(13) = {1, -1, 0};"
         "Point(14) = {0, -1, 0}; Circle(11) = {11, 14, 12}; Circle(12) = {12, 14, 13}; Line(13) = {13, 14};"
         "Line(14) = {14, 11}; Curve Loop(2) = {11:14}; Plane Surface(2) = {2};"
         "Transfinite Curve{1} = 11; Transfinite Curve{11} = 14;"
         "Physical Surface(\"up\") = {1}; Physical Surface(\"low\") = {2}; Physical Curve(\"foot\") = {1};"
         "Physical Curve(\"top\") = {11}; Physical Curve(\"axis\") = {4, 14}; Physical Curve(\"head\") = {3};"
         "Physical Curve(\"ground\") = {13};";
}

TEST(Audit, FindsContactAtTheEndOfACurveThatGoesOn) {
  const std::string rest = boundary("axis", "displacement = { x = 0 }") +
                           boundary("ground", "displacement = { y = 0 }") + boundary("head", "pressure = 300") +
                           pair("foot", "top");
  const TemporaryFolder folder;
  const Scene narrow = drawn(folder, cylinders("0.03"), {"up", "low"}, rest);
  EXPECT_EQ(before(narrow), "");
  const std::string lines = after(narrow);
  expect_contains(lines, "contact.0 (line ");
  expect_contains(lines, "contact reaches the end of ");
  expect_contains(lines, "near (0.0299955, ");
  const Scene wide = drawn(folder, cylinders("0.15"), {"up", "low"}, rest);  // contact ends at 0.046
  EXPECT_EQ(before(wide), "");
  EXPECT_EQ(after(wide), "");
}

// The block's top is named below the punch alone: it goes on, but the punch ends there.
TEST(Audit, IsSilentWhereTheOtherBodyEndsToo) {
  const TemporaryFolder folder;
  const Scene scene = drawn(
      folder,
      "Point(1) = {0, 0, 0}; Point(2) = {5, 0, 0}; Point(3) = {5, 1, 0}; Point(4) = {3, 1, 0}; Point(5) = {2, 1, 0};"
      "Point(6) = {0, 1, 0}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5};"
      "Line(5) = {5, 6}; Line(6) = {6, 1}; Curve Loop(1) = {1:6}; Plane Surface(1) = {1};"
      "Rectangle(2) = {2, 1, 0, 1, 1}; b() = Boundary{ Surface{2}; }; Physical Surface(\"block\") = {1};"
      "Physical Surface(\"punch\") = {2}; Physical Curve(\"foot\") = {b(0)}; Physical Curve(\"head\") = {b(2)};"
      "Physical Curve(\"ground\") = {1}; Physical Curve(\"seat\") = {4};",
      {"block", "punch"},
      held("ground") + boundary("head", "displacement = { x = 0 }") + boundary("head", "traction = [0, -10]") +
          pair("foot", "seat"));
  EXPECT_EQ(before(scene), "");
  EXPECT_EQ(after(scene), "");
}

}  // namespace
}  // namespace mortise::test
