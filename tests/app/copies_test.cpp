// Scenes of copies against the same scenes drawn body by body.
#include <gtest/gtest.h>

#include "app/solve_scene.hpp"
#include "gmsh/load_mesh.hpp"
#include "gmsh/write_msh.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

using test::TemporaryFolder;

// A square block at (x, y) with m elements a side.
const std::string block_macro = R"(
Macro block
  p = newp;
  Point(p) = {x, y, 0}; Point(p + 1) = {x + 1, y, 0}; Point(p + 2) = {x + 1, y + 1, 0}; Point(p + 3) = {x, y + 1, 0};
  c = newl;
  Line(c) = {p, p + 1}; Line(c + 1) = {p + 1, p + 2}; Line(c + 2) = {p + 2, p + 3}; Line(c + 3) = {p + 3, p};
  s = news;
  Curve Loop(s) = {c : c + 3};
  Plane Surface(s) = {s};
  Transfinite Curve{c : c + 3} = m + 1;
  Transfinite Surface{s};
  Recombine Surface{s};
Return
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
)";

// "fine" and "coarse" at one place.
const std::string two_blocks = block_macro + R"(
x = 0; y = 0; m = 3; Call block;
Physical Surface("coarse") = {s};
Physical Curve("coarse_south") = {c}; Physical Curve("coarse_east") = {c + 1};
Physical Curve("coarse_north") = {c + 2}; Physical Curve("coarse_west") = {c + 3};
m = 4; Call block;
Physical Surface("fine") = {s};
Physical Curve("south") = {c}; Physical Curve("east") = {c + 1};
Physical Curve("north") = {c + 2}; Physical Curve("west") = {c + 3};
)";

// 3 x 3 of them in turns.
const std::string drawn_wall = block_macro + R"(
For j In {0 : 2}
  For i In {0 : 2}
    x = i; y = j; m = 3 + (i + j) % 2; Call block;
    Physical Surface(Sprintf("b_%g_%g", i, j)) = {s};
    Physical Curve(Sprintf("b_%g_%g_south", i, j)) = {c}; Physical Curve(Sprintf("b_%g_%g_east", i, j)) = {c + 1};
    Physical Curve(Sprintf("b_%g_%g_north", i, j)) = {c + 2}; Physical Curve(Sprintf("b_%g_%g_west", i, j)) = {c + 3};
  EndFor
EndFor
)";

const std::string wall_scene = R"(
[materials.stone]
young = 10e9
poisson = 0.2
[bodies]
"b_*" = "stone"
[[boundary]]
on = "b_*_0_south"
displacement = { x = 0, y = 0 }
[[boundary]]
on = ["b_0_*_west", "b_2_*_east"]
displacement = { x = 0 }
[[boundary]]
on = "b_1_2_north"
pressure = 3e6
[[boundary]]
on = "b_2_2_north"
pressure = 1e6
[[contact]]
between = ["b_*", "b_*"]
initial_gap = "closed"
[method]
solver = "feti"
tolerance = 1e-11
)";

const std::string grid = R"([mesh]
file = "two.geo"
[[copies]]
body = ["coarse", "fine"]
name = "b_*"
grid = { count = [3, 3], step = [1, 1] }
)";

// Pressures of all pairs by curve and place.
std::map<std::tuple<std::string, double, double>, double> pressures(const Results& r) {
  std::map<std::tuple<std::string, double, double>, double> found;
  const auto rounded = [](double x) { return std::round(x * 1e6) / 1e6; };
  for (const ContactResults& contact : r.recovery.contacts)
    for (const ContactSide* side : {&contact.multiplier, &contact.opposite})
      for (const ContactNode& node : side->nodes)
        found[{side->curve, rounded(node.position.x()), rounded(node.position.y())}] = node.p;
  return found;
}

// The same pressures at the same places, to round-off of the largest.
void expect_same_pressures(const Results& copied, const Results& drawn, double tolerance) {
  const auto one = pressures(copied), other = pressures(drawn);
  ASSERT_EQ(one.size(), other.size());
  double largest = 0;
  for (const auto& [key, p] : other) largest = std::max(largest, p);
  EXPECT_GT(largest, 0);
  for (const auto& [key, p] : other) {
    ASSERT_TRUE(one.contains(key)) << std::get<0>(key) << " " << std::get<1>(key) << " " << std::get<2>(key);
    EXPECT_NEAR(one.at(key), p, tolerance * largest) << std::get<0>(key);
  }
}

class CopiedWall : public testing::Test {
 protected:
  CopiedWall() {
    folder_.write("two.geo", two_blocks);
    folder_.write("drawn.geo", drawn_wall);
    copied_ = read_scene(folder_.write("copied.toml", grid + wall_scene));
    drawn_ = read_scene(folder_.write("drawn.toml", "[mesh]\nfile = \"drawn.geo\"\n" + wall_scene));
  }
  TemporaryFolder folder_;
  Scene copied_, drawn_;
};

TEST_F(CopiedWall, IsTheDrawnOne) {
  const Results copied = solve_scene(copied_), drawn = solve_scene(drawn_);
  EXPECT_EQ(copied.status, Status::solved);
  EXPECT_EQ(copied.problem.pairs.size(), 12u);
  EXPECT_EQ(copied.problem.mesh.nodes.rows(), drawn.problem.mesh.nodes.rows());
  EXPECT_NEAR(copied.recovery.energy, drawn.recovery.energy, 1e-10 * drawn.recovery.energy);
  expect_same_pressures(copied, drawn, 1e-9);
}

TEST_F(CopiedWall, AsAMshIsTheSame) {
  const Mesh mesh = scene_mesh(copied_);
  write_msh(mesh, folder_.path("wall.msh"));
  const Mesh read = load_mesh(folder_.path("wall.msh"), {});
  EXPECT_EQ(read.bodies, mesh.bodies);
  EXPECT_EQ(boundary_names(read), boundary_names(mesh));
  const std::string scene = folder_.write("msh.toml", "[mesh]\nfile = \"wall.msh\"\n" + wall_scene);
  expect_same_pressures(solve_scene(read_scene(scene)), solve_scene(copied_), 1e-9);
}

// Of a .msh there are copies too.
TEST_F(CopiedWall, IsMadeFromAMsh) {
  write_msh(load_mesh(folder_.path("two.geo"), {}), folder_.path("two.msh"));
  const Results of_msh = solve_scene(read_scene(folder_.path("copied.toml"), {{"mesh.file", folder_.path("two.msh")}}));
  expect_same_pressures(of_msh, solve_scene(copied_), 1e-9);
}

TEST_F(CopiedWall, IsRefusedWithTheScenesPath) {
  const std::string path = folder_.path("copied.toml");
  EXPECT_EQ(test::message_of([&] {
              check_scene(read_scene(path, {{"copies.0.body", "fine"}, {"bodies.fine", "stone"}}));
            }).substr(0, path.size()),
            path);
  EXPECT_EQ(test::message_of([&] {
              scene_mesh(read_scene(path, {{"copies.0.body", "finer"}}));
            }),
            path + ": copies.0 (line 3): unknown body 'finer'; did you mean 'fine'? known: coarse, fine (" +
                folder_.path("two.geo") + ")");
  const std::string refusal = test::message_of([&] { read_scene(path, {{"accuracy.value", "1%"}}); });
  test::expect_contains(refusal, "a mesh is found for drawn bodies, not for copies (copies.0 (line 3))");
}

// Entries for all bodies are those of each: a name of its own counts before a pattern.
TEST_F(CopiedWall, TakesBodyForcesAndStrainsByPatterns) {
  const auto solved = [&](const std::string& forces, const std::string& strains) {
    return solve_scene(read_scene(folder_.path("drawn.toml"), {{"body_force", forces}, {"initial_strain", strains}}));
  };
  std::string forces, strains;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const std::string body = "body='b_" + std::to_string(i) + "_" + std::to_string(j) + "', ";
      const bool own = i == 1 && j == 1;
      forces += "{" + body + "force=[0, " + (own ? "-9e5" : "'-2e5*(1+x)'") + "]},";
      strains += "{" + body + "strain={xx=" + (own ? "3e-6" : "1e-6") + "}},";
    }
  const Results each = solved("[" + forces + "]", "[" + strains + "]");
  for (const std::string all : {"*", "b_*", "b_*_*"}) {
    const Results patterns = solved("[{body='b_1_1', force=[0, -9e5]}, {body='" + all + "', force=[0, '-2e5*(1+x)']}]",
                                    "[{body='" + all + "', strain={xx=1e-6}}, {body='b_1_1', strain={xx=3e-6}}]");
    EXPECT_NEAR(patterns.recovery.energy, each.recovery.energy, 1e-10 * each.recovery.energy) << all;
    expect_same_pressures(patterns, each, 1e-9);
  }
  EXPECT_GT(std::abs(each.recovery.energy - solve_scene(drawn_).recovery.energy), 0.01 * each.recovery.energy);
}

TEST_F(CopiedWall, RefusesABodyThatTwoPatternsLoad) {
  const auto refusal = [&](const std::string& key, const std::string& entries) {
    return test::message_of([&] { check_scene(read_scene(folder_.path("copied.toml"), {{key, entries}})); });
  };
  const std::string twice = refusal("body_force", "[{body='b_0_*', force=[0, 1]}, {body='*_0', force=[0, 2]}]");
  test::expect_contains(twice, "body_force.1");
  test::expect_contains(twice, "body 'b_0_0' is a '*_0', and a 'b_0_*' of body_force.0");
  test::expect_contains(refusal("body_force", "[{body='stone_*', force=[0, 1]}]"), "unknown body 'stone_*'");
  test::expect_contains(refusal("initial_strain", "[{body='b_9_*', strain={xx=1e-6}}]"), "unknown body 'b_9_*'");
  test::expect_contains(refusal("initial_strain", "[{body='*', temperature_change=1}]"), "without thermal_expansion");
}

// Two blocks on one another, turned as a whole: nothing that the pressure could tell.
TEST(TurnedCopies, HaveTheSamePressures) {
  const TemporaryFolder folder;
  folder.write("two.geo", two_blocks);
  const std::string scene = R"(
[[copies]]
body = "coarse"
name = "lower"
centre = [2, -1]
places = [[0, 0, ANGLE]]
[[copies]]
body = "fine"
name = "upper"
centre = [2, -1]
places = [[SHIFT, ANGLE]]
[materials.stone]
young = 10e9
poisson = 0.2
[bodies]
"*" = "stone"
[[boundary]]
on = "lower_south"
displacement = { x = 0, y = 0 }
[[boundary]]
on = "upper_north"
pressure = 1e6
[[contact]]
between = ["lower_north", "upper_south"]
)";
  const auto solved = [&](double degrees) {
    const double angle = degrees * M_PI / 180;
    std::ostringstream shift;  // the upper one stands by 0.3 beside the lower one
    shift.precision(17);
    shift << 0.3 * std::cos(angle) - std::sin(angle) << ", " << 0.3 * std::sin(angle) + std::cos(angle);
    std::string text = "[mesh]\nfile = \"two.geo\"\n" + scene;
    const auto put = [&](const std::string& word, const std::string& value) {
      for (std::size_t at; (at = text.find(word)) != std::string::npos;) text.replace(at, word.size(), value);
    };
    put("SHIFT", shift.str());
    put("ANGLE", std::to_string(degrees));
    return solve_scene(read_scene(folder.write("turned.toml", text)));
  };
  const Results upright = solved(0);
  ASSERT_EQ(upright.status, Status::solved);
  EXPECT_LT(upright.recovery.contacts[0].length_in_contact, 0.75);
  for (const double degrees : {30.0, 90.0, -163.5}) {
    const Results turned = solved(degrees);
    ASSERT_EQ(turned.status, Status::solved) << degrees;
    VecX p = upright.recovery.contacts[0].pressure, q = turned.recovery.contacts[0].pressure;
    ASSERT_EQ(p.size(), q.size());
    if ((p - q).norm() > (p - q.reverse()).norm()) q = q.reverse().eval();  // s may run the other way
    EXPECT_LE((p - q).cwiseAbs().maxCoeff(), 1e-9 * p.maxCoeff()) << degrees;
    EXPECT_NEAR(turned.recovery.energy, upright.recovery.energy, 1e-9 * upright.recovery.energy);
  }
}

}  // namespace
}  // namespace mortise
