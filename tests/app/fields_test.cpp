// Scenes whose temperature, strain or load comes from a file.
#include <gtest/gtest.h>

#include "app/solve_scene.hpp"
#include "results/report_text.hpp"
#include "results/write_results.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// A quarter of a ring, 1 <= r <= 2, held on its lines of symmetry.
Scene ring_scene(const TemporaryFolder& folder, const std::string& name, double size, const std::string& rest) {
  folder.write("ring.geo", R"geo(
DefineConstant[size = 0.2];
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Disk(1) = {0, 0, 0, 2}; Disk(2) = {0, 0, 0, 1}; Rectangle(3) = {0, 0, 0, 3, 3};
BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
BooleanIntersection(5) = { Surface{4}; Delete; }{ Surface{3}; Delete; };
Mesh.CharacteristicLengthMin = size;
Mesh.CharacteristicLengthMax = size;
Physical Surface("ring") = {5};
For i In {0 : 1}
  c() = Curve In BoundingBox{-1e-3, -1e-3, -1, i == 0 ? 3 : 1e-3, i == 0 ? 1e-3 : 3, 1};
  Physical Curve(Sprintf("cut_%g", i)) = {c()};
EndFor
)geo");
  return read_scene(
      folder.write(name + ".toml", "mesh.file = \"ring.geo\"\nmesh.parameters.size = " + std::to_string(size) + R"toml(
materials.m = { young = 1000, poisson = 0.3, thermal_expansion = 1e-5 }
bodies.ring = "m"
boundary = [{ on = "cut_0", displacement = { y = 0 } }, { on = "cut_1", displacement = { x = 0 } }]
)toml" + rest));
}

double largest_difference(const VecX& a, const VecX& b) { return largest_entry(a - b) / largest_entry(b); }

// The source has the field as displacement of a run of its own, on a mesh that is coarser and of which only the nodes
// lie on the circles.
TEST(Fields, AResultOfAnotherRunIsATemperature) {
  const TemporaryFolder folder;
  const Scene source = ring_scene(folder, "source", 0.4, R"toml(
initial_strain = [{ body = "ring", strain = { xx = 0.02, yy = 0.01 } }]
)toml");
  write_results(solve_scene(source), folder.path("source"));
  const std::string heated = "initial_strain = [{ body = \"ring\", temperature_change = \"";
  const Results by_file = solve_scene(ring_scene(folder, "by_file", 0.2, heated + R"toml(20 + 100 * u - v" }]
[fields]
u = { file = "source/result.vtu", values = "displacement", component = 0 }
v = { file = "source/result.vtu", values = "displacement", component = 1 }
)toml"));
  // Free expansion, but that the plane strain adds nu eps_33 = 0: of the strain as given u = (0.02 x, 0.01 y).
  const Results as_expression =
      solve_scene(ring_scene(folder, "as_expression", 0.2, heated + "20 + 2 * x - 0.01 * y\" }]"));
  EXPECT_LT(largest_difference(by_file.solution.u, as_expression.solution.u), 1e-10);
  EXPECT_EQ(by_file.status, Status::solved);
}

TEST(Fields, ATableIsAStrainAPressureAndABodyForce) {
  const TemporaryFolder folder;
  std::ostringstream table;
  table.precision(17);
  table << "x,y,q\n";
  for (int i = 0; i <= 12; ++i)
    for (int j = 0; j <= 12; ++j) table << 0.2 * i << "," << 0.2 * j << "," << 1 + 0.2 * i - 0.04 * j << "\n";
  folder.write("table.csv", table.str());
  const auto rest = [](const std::string& q) {
    return "initial_strain = [{ body = \"ring\", strain = { xx = \"1e-3 * (" + q + ")\" } }]\n" +
           "body_force = [{ body = \"ring\", force = [\"" + q + "\", 0] }]\n";
  };
  const Scene by_file = ring_scene(folder, "by_file", 0.3, rest("q") + "fields.q = { file = \"table.csv\" }\n");
  const Results r = solve_scene(by_file);
  const Results exact = solve_scene(ring_scene(folder, "exact", 0.3, rest("1 + x - 0.2 * y")));
  EXPECT_LT(largest_difference(r.solution.u, exact.solution.u), 1e-12);
  EXPECT_NEAR(r.recovery.energy, exact.recovery.energy, 1e-12 * exact.recovery.energy);
  expect_contains(model_text(model_report(r.problem)), "  field     q: q of " + folder.path("table.csv"));
}

TEST(Fields, WhatCannotBeIsToldAtTheScene) {
  const TemporaryFolder folder;
  folder.write("table.csv", "x,y,q\n0,0,1\n2,0,1\n0,1.5,1\n2,1.5,1\n");
  const auto message = [&](const std::string& rest) {
    return message_of([&] { check_scene(ring_scene(folder, "scene", 0.3, rest)); });
  };
  const std::string scene = folder.path("scene.toml") + ":";
  expect_contains(
      message("initial_strain = [{ body = \"ring\", temperature_change = \"q\" }]\nfields.q.file = \"table.csv\""),
      scene + " fields.q (line 7): (");
  expect_contains(message("initial_strain = [{ body = \"ring\", temperature_change = \"q\" }]\nfields.q = { file = "
                          "\"table.csv\", values = \"Q\" }"),
                  scene + " fields.q (line 7): " + folder.path("table.csv") + ":1: unknown column 'Q'");
  expect_contains(message("fields.q = { file = \"tables.csv\" }"), "no such file; did you mean 'table.csv'?");
  expect_contains(message("fields.q = { file = \"ring.geo\" }"), "expected a file that ends in .vtu or .csv");
  expect_contains(message("fields.x = { file = \"table.csv\" }"), "'x' cannot be a name in expressions");
  expect_contains(message("constants.T = 1\nfields.T = { file = \"table.csv\" }"),
                  "fields.T: is one of [constants] too; expected another name");
  expect_contains(message("fields.q = { file = \"table.csv\", component = 0 }"), "is of the arrays of a .vtu");
  expect_contains(message("fields.q = { file = \"table.csv\" }"),
                  scene + "6: fields.q: no expression has the field 'q'; expected it in one");
}

}  // namespace
}  // namespace mortise::test
