// Contact curves in pieces: surfaces with grooves in them, and what their pieces are called.
#include <gtest/gtest.h>

#include <fstream>

#include "app/accuracy.hpp"
#include "app/solve_scene.hpp"
#include "results/report.hpp"
#include "results/setup_json.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

const std::string one_name = R"(Physical Curve("seat") = {3, 7, 11}; Physical Curve("foot") = {21, 25};)";
const std::string names = R"(
Physical Curve("seat_1") = {11}; Physical Curve("seat_2") = {7}; Physical Curve("seat_3") = {3};
Physical Curve("foot_1") = {21}; Physical Curve("foot_2") = {25};)";
const std::string one_entry = "[[contact]]\nbetween = [\"foot\", \"seat\"]\n";

// A base with two grooves, and a deck with one, on it.
Scene grooves(const TemporaryFolder& folder, const std::string& named, const std::string& contact,
              const std::vector<Override>& more = {}) {
  folder.write("a.geo", R"(
Point(1) = {0, 0, 0}; Point(2) = {8, 0, 0}; Point(3) = {8, 2, 0}; Point(4) = {6, 2, 0}; Point(5) = {6, 1.5, 0};
Point(6) = {5, 1.5, 0}; Point(7) = {5, 2, 0}; Point(8) = {2.5, 2, 0}; Point(9) = {2.5, 1.5, 0};
Point(10) = {1.5, 1.5, 0}; Point(11) = {1.5, 2, 0}; Point(12) = {0, 2, 0};
DefineConstant[y = 2];
Point(21) = {0, y, 0}; Point(22) = {3, y, 0}; Point(23) = {3, y + 0.5, 0}; Point(24) = {4, y + 0.5, 0};
Point(25) = {4, y, 0}; Point(26) = {8, y, 0}; Point(27) = {8, y + 1, 0}; Point(28) = {0, y + 1, 0};
For i In {1 : 11}
  Line(i) = {i, i + 1};
EndFor
Line(12) = {12, 1};
For i In {21 : 27}
  Line(i) = {i, i + 1};
EndFor
Line(28) = {28, 21};
Curve Loop(1) = {1 : 12}; Plane Surface(1) = {1}; Curve Loop(2) = {21 : 28}; Plane Surface(2) = {2};
MeshSize{:} = 0.5; MeshSize{21 : 28} = 0.3; Mesh.ElementOrder = 2;
Physical Surface("base") = {1}; Physical Surface("deck") = {2};
Physical Curve("bottom") = {1}; Physical Curve("top") = {27}; Physical Curve("side") = {28};
)" + named);
  return read_scene(folder.write("a.toml", R"(
mesh.file = "a.geo"
materials.steel = { young = 200, poisson = 0.3 }
bodies = { "*" = "steel" }
)" + contact + R"(
[[boundary]]
on = "bottom"
displacement = { x = 0, y = 0 }
[[boundary]]
on = "side"
displacement = { x = 0 }
[[boundary]]
on = "top"
pressure = "1 + x / 8"
)"),
                    more);
}

std::string each_pair(const std::string& keys = "") {
  std::string text;
  for (const char* between :
       {"\"foot_1\", \"seat_1\"", "\"foot_1\", \"seat_2\"", "\"foot_2\", \"seat_2\"", "\"foot_2\", \"seat_3\""})
    text += std::string("[[contact]]\nbetween = [") + between + "]\n" + keys;
  return text;
}

std::vector<std::string> pair_names(const Problem& problem) {
  std::vector<std::string> found;
  for (const ContactPair& pair : problem.pairs) found.push_back(pair.spec.between[0] + " " + pair.spec.between[1]);
  return found;
}

TEST(ContactPieces, AreThePairsThatTheirOwnNamesMake) {
  const TemporaryFolder one, apart;
  for (const char* more :
       {"", "multipliers_on = \"foot\"\n", "multipliers_on = \"seat\"\n", "condition = \"tied\"\n"}) {
    const Results r = solve_scene(grooves(one, one_name, one_entry + more));
    const std::string side = more, keys = side.find("_on") == std::string::npos ? side : "";
    Scene named = grooves(apart, names, each_pair(keys));
    for (ContactSpec& contact : named.contacts)
      if (keys != side) contact.multipliers_on = contact.between[side.find("seat") == std::string::npos ? 0 : 1];
    const Results alone = solve_scene(named);
    EXPECT_EQ(r.status, alone.status) << more;
    EXPECT_EQ(r.solution.u, alone.solution.u) << more;
    EXPECT_EQ(r.solution.lambda, alone.solution.lambda) << more;
    EXPECT_EQ(pair_names(r.problem), pair_names(alone.problem)) << more;
    EXPECT_EQ(r.warnings, alone.warnings) << more;
  }
}

TEST(ContactPieces, AreMeshedForAnAccuracy) {
  const TemporaryFolder folder;
  Scene scene = grooves(folder, one_name, one_entry);
  scene.accuracy = AccuracySpec{.value = 0.05};
  const Results r = solve_to_accuracy(scene).value();
  EXPECT_EQ(r.status, Status::solved);
  EXPECT_EQ(pair_names(r.problem),
            (std::vector<std::string>{"foot_1 seat_1", "foot_1 seat_2", "foot_2 seat_2", "foot_2 seat_3"}));
  double force = 0;
  for (const ContactResults& contact : r.recovery.contacts) force += std::abs(contact.force.y());
  EXPECT_NEAR(force, 12, 1e-9 * 12);
}

TEST(ContactPieces, GoWithPatternsAndEntriesOfTheirOwn) {
  const TemporaryFolder folder;
  const std::string pattern = "[[contact]]\nbetween = [\"f*\", \"s*t\"]\n";
  EXPECT_EQ(pair_names(check_scene(grooves(folder, one_name, pattern))).size(), 4u);
  EXPECT_EQ(pair_names(check_scene(grooves(folder, one_name, pattern + one_entry))).size(), 4u);
  const std::string of_both = "Physical Curve(\"fat\") = {3, 21};\n";  // of two bodies: none, and no pieces either
  EXPECT_EQ(pair_names(check_scene(grooves(folder, one_name + of_both, pattern))).size(), 4u);
  // A number that is taken is left out.
  const Problem taken = check_scene(grooves(folder, one_name + "Physical Curve(\"seat_2\") = {2};", one_entry));
  EXPECT_EQ(pair_names(taken),
            (std::vector<std::string>{"foot_1 seat_1", "foot_1 seat_3", "foot_2 seat_3", "foot_2 seat_4"}));
}

TEST(ContactPieces, AreDrawnInPlaceOfTheWhole) {
  const TemporaryFolder folder;
  write_setup(check_scene(grooves(folder, one_name, one_entry)), folder.path("setup.json"));
  std::ifstream file(folder.path("setup.json"));
  const Json curves = Json::parse(file)["curves"];
  EXPECT_FALSE(curves.contains("seat"));
  for (const char* name : {"foot_1", "foot_2", "seat_1", "seat_2", "seat_3", "bottom"})
    EXPECT_TRUE(curves.contains(name));
}

TEST(ContactPieces, FaceEachOtherOverAnyGap) {
  const TemporaryFolder folder;
  EXPECT_EQ(pair_names(check_scene(grooves(folder, one_name, one_entry, {{"mesh.parameters.y", "3"}}))).size(), 4u);
}

TEST(ContactPieces, AreNoPlacesForSupportsAndOneFluid) {
  const TemporaryFolder folder;
  expect_contains(message_of([&] {
                    check_scene(grooves(folder, one_name, one_entry, {{"boundary.0.on", "seat_1"}}));
                  }),
                  "seat_1");
  expect_contains(message_of([&] {
                    check_scene(grooves(folder, one_name, one_entry + "fluid = { pressure = 1, from = [0, 2] }\n"));
                  }),
                  "fluid: 'foot' or 'seat' falls into pieces; expected two curves of one piece each");
}

TEST(ContactPieces, ThatFaceNothingAreRefused) {
  const TemporaryFolder folder;
  expect_contains(
      message_of([&] { check_scene(grooves(folder, one_name, "[[contact]]\nbetween = [\"foot\", \"bottom\"]\n")); }),
      "between: no curves 'foot' and 'bottom' of two bodies face each other anywhere; expected others");
}

}  // namespace
}  // namespace mortise::test
