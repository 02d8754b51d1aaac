// [[case]] as a user writes it: each is the scene with the values that it says; and as one miswrites it.
#include <gtest/gtest.h>

#include "scene/scene_files.hpp"
#include "support/messages.hpp"

namespace mortise::test {
namespace {

// A scene of loads of every kind, with cases and a table beside it.
Scene with_cases(const std::string& cases, const std::string& table = "") {
  const TemporaryFolder folder;
  folder.write("block.msh", "");
  if (!table.empty()) folder.write("cases.csv", table);
  return read_scene(folder.write("scene.toml", "title = \"loads\"\n" + shortest_scene + R"(
[[boundary]]
on = "left"
displacement = { x = 1e-3, y = "2 * x" }
[[boundary]]
on = "top"
pressure = 10
[[boundary]]
on = "right"
rigid = { x = 1, force = [0, 2], moment = 3 }
[[boundary]]
on = "foot"
foundation = 7
[[body_force]]
body = "block"
force = [0, "y"]
[[initial_strain]]
body = "block"
strain = { xx = 0.25 }
[[contact]]
between = ["a", "b"]
clearance = 5e-6
)" + cases));
}

// Wherever an expression may stand, and whatever then takes its place.
TEST(Constants, AreUsedByAnyExpressionOfTheSceneAndItsCases) {
  const TemporaryFolder folder;
  folder.write("block.msh", "");
  folder.write("cases.csv", "name,boundary.0.pressure\nall,2 * load_of_case\n");
  const auto read = [&](const std::string& rest, const std::vector<Override>& overrides = {}) {
    return message_of([&] {
      read_scene(folder.write("scene.toml", "title = \"loads of cc\"\n" + shortest_scene + R"(
[[boundary]]
on = "top"
pressure = "c * x"
)" + rest),
                 overrides);
    });
  };
  const std::string none = "(nothing was thrown)";
  const std::string entries = R"(
[[contact]]
between = ["a", "b"]
clearance = "c_1"
stiffness = 1e9
[[body_force]]
body = "block"
force = [0, "3*gravity_*y"]
[[initial_strain]]
body = "block"
strain = { xx = "hot" }
[[expect]]
pair = 0
pressure = "wanted"
tolerance = 0.1
[[case]]
"boundary.0.pressure" = "of_case"
[[case]]
"constants.c" = 3
[[case]]
file = "cases.csv"
)";
  EXPECT_EQ(read(entries + "[constants]\nc = 1\nc_1 = 1\ngravity_ = 1\nhot = 0.5\nwanted = 1\nof_case = 1\n" +
                 "load_of_case = 1"),
            none);
  EXPECT_EQ(read("[constants]\nc = 1", {{"boundary.0.pressure", "5"}}), none);
  EXPECT_EQ(read("", {{"constants.c", "5"}}), none);
  EXPECT_EQ(read("[constants]\nc = 1\nd = 2", {{"boundary.0.pressure", "c"}}), none);  // or "d", of a sweep
  const std::string unused = ": no expression has the constant 'cc'; did you mean 'c'?";
  for (const std::vector<Override>& overrides : {std::vector<Override>{}, {{"model.plane", "stress"}}})
    expect_contains(read("[constants]\nc = 1\ncc = 1", overrides), unused);
  expect_contains(read("[constants]\nc = 1", {{"constants.cc", "5"}}), "--set constants.cc=5: constants.cc" + unused);
  expect_contains(read("[constants]\nc = 1\n[[case]]\n\"constants.cc\" = 2"), unused);
  expect_contains(read("[constants]\nc = 1\ndepth = 1"), "no expression has the constant 'depth'; expected it in one");
}

const Scene& only(const Scene& scene) { return scene.cases.at(0).scene; }

double pressure(const Scene& scene) { return std::get<Pressure>(scene.boundaries[1].what).value.constant(); }

TEST(ReadCases, ChangeTheKeysThatTheyName) {
  const Scene scene = with_cases(R"(
[[case]]
name = "more"
boundary.1.pressure = 20
[[case]]
"boundary.1.pressure" = 30
boundary.0.displacement.x = 2e-3
materials.steel = { poisson = 0.1 }
contact.clearance = "x"
[[case]]
name = "as_it_is"
)");
  ASSERT_EQ(scene.cases.size(), 3);
  EXPECT_EQ(pressure(scene), 10);
  EXPECT_EQ(scene.cases[0].name, "more");
  EXPECT_EQ(pressure(scene.cases[0].scene), 20);
  const LoadCase& second = scene.cases[1];
  EXPECT_EQ(second.name, "1");
  EXPECT_EQ(pressure(second.scene), 30);
  const Displacement& u = std::get<Displacement>(second.scene.boundaries[0].what);
  EXPECT_EQ(u.x->constant(), 2e-3);
  EXPECT_EQ((*u.y)(Vec2(3, 0)), 6);
  EXPECT_EQ(second.scene.materials.at("steel").young, 210e9);
  EXPECT_EQ(second.scene.materials.at("steel").poisson, 0.1);
  EXPECT_EQ(second.scene.contacts[0].clearance(Vec2(4, 0)), 4);
  const std::vector<std::pair<std::string, std::string>> changed{{"boundary.1.pressure", "30"},
                                                                 {"boundary.0.displacement.x", "0.002"},
                                                                 {"materials.steel.poisson", "0.1"},
                                                                 {"contact.clearance", "x"}};
  EXPECT_EQ(second.changed, changed);
  EXPECT_EQ(pressure(scene.cases[2].scene), 10);
  EXPECT_TRUE(scene.cases[2].scene.cases.empty());
}

TEST(ReadCases, ScaleLoadsAndNothingElse) {
  const Scene scene = with_cases("[[case]]\nscale = 3\n"), &scaled = only(scene);
  EXPECT_EQ(scene.cases[0].name, "scale_3");
  const Displacement& u = std::get<Displacement>(scaled.boundaries[0].what);
  EXPECT_DOUBLE_EQ(u.x->constant(), 3e-3);
  EXPECT_DOUBLE_EQ((*u.y)(Vec2(5, 0)), 30);
  EXPECT_EQ(u.y->words(), "3 * (2 * x)");
  EXPECT_EQ(pressure(scaled), 30);
  const RigidSpec& rigid = std::get<RigidSpec>(scaled.boundaries[2].what);
  EXPECT_EQ(rigid.x, 3);
  EXPECT_EQ(rigid.force, Vec2(0, 6));
  EXPECT_EQ(rigid.moment, 9);
  EXPECT_EQ(std::get<NormalFoundation>(scaled.boundaries[3].what).modulus.constant(), 7);
  EXPECT_EQ(scaled.body_forces[0].force.y(Vec2(0, 2)), 6);
  EXPECT_EQ(scaled.initial_strains[0].strain[0].constant(), 0.75);
  EXPECT_EQ(scaled.contacts[0].clearance.constant(), 5e-6);
  // Of what the case says itself, too; and times is of times.
  EXPECT_EQ(pressure(only(with_cases("[[case]]\nscale = 3\nboundary.1.pressure = 2\n"))), 6);
  EXPECT_EQ(Field("x", {}).times(2).times(3)(Vec2(1, 0)), 6);
  EXPECT_FALSE(Field("x", {}).times(2) == Field("x", {}));
}

TEST(ReadCases, ManyScalesOrATable) {
  const Scene scales = with_cases("[[case]]\nname = \"load\"\nscale = [0.5, 2]\n[[case]]\nscale = [1e-3]\n");
  ASSERT_EQ(scales.cases.size(), 3);
  EXPECT_EQ(scales.cases[0].name, "load_0.5");
  EXPECT_EQ(scales.cases[1].name, "load_2");
  EXPECT_EQ(scales.cases[2].name, "scale_0.001");
  EXPECT_EQ(pressure(scales.cases[1].scene), 20);
  const Scene table = with_cases("[[case]]\nfile = \"cases.csv\"\n[cases]\nwrite = \"all\"\n",
                                 "\xef\xbb\xbfname;scale;boundary.1.pressure\na;;20\n\nb;0.5;\"30\"\n;2;\"1 + x\"\n");
  ASSERT_EQ(table.cases.size(), 3);
  EXPECT_EQ(table.case_files, CaseFiles::all);
  EXPECT_EQ(table.cases[0].name, "a");
  EXPECT_EQ(pressure(table.cases[0].scene), 20);
  EXPECT_EQ(pressure(table.cases[1].scene), 15);
  EXPECT_EQ(table.cases[2].name, "2");
  EXPECT_EQ(std::get<Pressure>(table.cases[2].scene.boundaries[1].what).value(Vec2(3, 0)), 8);
}

TEST(ReadCases, Miswritten) {
  const auto expect = [](const std::string& text, const std::string& part, const std::string& table = "") {
    expect_contains(message_of([&] { with_cases(text, table); }), part);
  };
  expect("[[case]]\nnam = \"a\"", "unknown key 'nam'");
  expect("[[case]]\nboundary.9.pressure = 1", "scene.toml:32: boundary: no entry with index 9");
  expect("[[case]]\nboundary.1.presure = 1", "unknown key 'presure'; did you mean 'pressure'?");
  expect("[[case]]\nboundary.1.pressure = \"q\"", "scene.toml:32");
  expect("[[case]]\nname = \"a\"\n[[case]]\nname = \"a\"", "case.1.name: 'a' is the name of a case before it");
  expect("[[case]]\nname = \"a\"\nscale = [1, 1]", "'a_1' is the name of a case before it");
  for (const char* name : {"a/b", "..", "a b", "\u00e4"})
    expect("[[case]]\nname = \"" + std::string(name) + "\"", "expected letters, digits and _ - + .");
  expect("[[case]]\nname = \"" + std::string(101, 'a') + "\"", "at most 100");
  expect("[[case]]\nscale = []", "case.0.scale: expected a number or a list of numbers");
  expect("[[case]]\nscale = [\"a\"]", "expected a number");
  expect("[[case]]\ncase.0.scale = 1", "a case has no cases");
  expect("[[case]]\nfile = \"none.csv\"", "case.0.file");
  expect("[[case]]\nfile = \"cases.csv\"\nname = \"a\"", "goes with no other key", "name\na\n");
  expect("[cases]\nwrite = \"some\"", "known: table, contact, all");
  const auto expect_of_table = [&](const std::string& table, const std::string& part) {
    expect("[[case]]\nfile = \"cases.csv\"", part, table);
  };
  expect_of_table("name,\na,1\n", "cases.csv:1: a column without a name");
  expect_of_table("name,scale,scale\na,1,2\n", "cases.csv:1: two columns 'scale'; expected one a key");
  expect_of_table("name,scale\n\n", "cases.csv' has no rows; expected one a case, below the names");
  expect_of_table("name,scale\na\n", "cases.csv:2: 1 fields; expected 2, as the first line has");
  expect_of_table("name,scale\na,b\n", "cases.csv:2: scale: expected a number");
  expect_of_table("name,materials.steel.young\na,1e9\nb,-3\n",
                  "cases.csv:3: materials.steel.young: expected a number > 0");
  expect_of_table("boundary.1.presure\n1\n", "unknown key 'presure'");
  expect_of_table("cases.write\nall\n", "cases.csv:1: cases.write: a case has no cases");
  expect_of_table(
      "name\n" +
          [] {
            std::string rows;
            for (int k = 0; k <= 10000; ++k) rows += "c" + std::to_string(k) + "\n";
            return rows;
          }(),
      "more than 10000 cases; expected fewer, or several scenes");
}

}  // namespace
}  // namespace mortise::test
