// Meshes that cannot be what their author meant, each with what must be said about it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../mesh/grid.hpp"
#include "base/errors.hpp"
#include "gmsh/load_mesh.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

using test::message_of;
using test::TemporaryFolder;

/// A unit square with its lower left corner at (x, x), curves 10 s + 1..4, surface s, not in any physical group.
std::string square(int s, const std::string& x) {
  const auto tag = [s](int i) { return std::to_string(10 * s + i); };
  return "Point(" + tag(1) + ") = {" + x + "," + x + ",0}; Point(" + tag(2) + ") = {" + x + "+1," + x + ",0};\n" +  //
         "Point(" + tag(3) + ") = {" + x + "+1," + x + "+1,0}; Point(" + tag(4) + ") = {" + x + "," + x + "+1,0};\n" +
         "Line(" + tag(1) + ") = {" + tag(1) + "," + tag(2) + "}; Line(" + tag(2) + ") = {" + tag(2) + "," + tag(3) +
         "}; Line(" + tag(3) + ") = {" + tag(3) + "," + tag(4) + "}; Line(" + tag(4) + ") = {" + tag(4) + "," + tag(1) +
         "};\n" + "Curve Loop(" + std::to_string(s) + ") = {" + tag(1) + ":" + tag(4) + "}; Plane Surface(" +
         std::to_string(s) + ") = {" + std::to_string(s) + "};\nTransfinite Curve {" + tag(1) + ":" + tag(4) +
         "} = 3; Transfinite Surface {" + std::to_string(s) + "};\n";
}

const std::string kBody = square(1, "0") + "Physical Surface(\"body\") = {1};\n";

/// A .msh 2.2 of one body "body" (surface 1) and a boundary "edge" (curve 1).
std::string msh(const std::string& nodes, const std::string& elements) {
  const auto count = [](const std::string& text) { return std::to_string(std::count(text.begin(), text.end(), '\n')); };
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 2 \"edge\"\n2 1 \"body\"\n$EndPhysicalNames\n"
         "$Nodes\n" +
         count(nodes) + "\n" + nodes + "$EndNodes\n$Elements\n" + count(elements) + "\n" + elements + "$EndElements\n";
}

const std::string kUnitNodes = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 2 0 0\n";

struct BrokenMesh {
  std::string name, file, text;
  std::map<std::string, double> parameters;
  std::vector<std::string> said;
};

std::vector<BrokenMesh> broken_meshes() {
  return {
      {"no extension", "mesh", "", {}, {"mesh: a mesh file ends in .geo or .msh"}},
      {"other kind", "a.vtu", "", {}, {"a.vtu: a mesh file ends in .geo or .msh"}},
      {"syntax",
       "a.geo",
       "Point(1) = {0, 0, 0};\nPoint(2) = {1, 0;\n",
       {},
       {"gmsh, reading", "a.geo', line 2", "syntax error"}},
      {"syntax with parameters",
       "a.geo",
       "DefineConstant[ n = 1 ];\nPoint(2) = {1, 0;\n",
       {{"n", 2}},
       {"a.geo', line 2", "syntax error"}},
      {"unknown variable", "a.geo", "x = y + 1;\n", {}, {"a.geo', line 1", "Unknown variable 'y'"}},
      {"missing include", "a.geo", "Include \"none.geo\";\n", {}, {"none.geo"}},
      {"error command", "a.geo", "Error(\"no such plate\");\n", {}, {"no such plate"}},
      {"exit", "a.geo", "Exit;\n", {}, {"a.geo: gmsh ended the program", "Exit"}},
      {"curves that cross",
       "a.geo",
       "Point(1)={0,0,0,1}; Point(2)={1,0,0,1}; Point(3)={0,1,0,1}; Point(4)={1,1,0,1};\nLine(1)={1,2}; Line(2)={2,3}; "
       "Line(3)={3,4}; Line(4)={4,1}; Curve Loop(1)={1:4}; Plane Surface(1)={1};\nPhysical Surface(\"body\")={1};\n",
       {},
       {"gmsh, meshing"}},
      {"unknown parameter",
       "a.geo",
       "DefineConstant[ n_upper = 3 ];\n" + kBody,
       {{"n_uper", 3}},
       {"a.geo: unknown parameter", "'n_uper'; did you mean 'n_upper'?"}},
      {"infinite parameter",
       "a.geo",
       "DefineConstant[ n = 3 ];\n" + kBody,
       {{"n", INFINITY}},
       {"parameter 'n' is not a finite number"}},
      {"parameter of a msh",
       "a.msh",
       msh(kUnitNodes, "1 3 2 1 1 1 2 3 4\n"),
       {{"n", 3}},
       {"parameter 'n' given to a mesh"}},
      {"empty geo", "a.geo", "", {}, {"no physical surface"}},
      {"empty msh", "a.msh", "", {}, {"a.msh, line 1: "}},
      {"not a msh", "a.msh", "hello world\n", {}, {"a.msh, line 1: this is no .msh"}},
      {"half a msh", "a.msh", msh(kUnitNodes, "1 3 2 1 1 1 2 3 4\n").substr(0, 140), {}, {"a.msh, line ", "$Nodes"}},
      {"no body", "a.geo", square(1, "0") + "Physical Curve(\"side\") = {11};", {}, {"no physical surface"}},
      {"surface of no body",
       "a.geo",
       kBody + square(2, "3"),
       {},
       {"surface 2 near (3.5, 3.5)", "in no physical surface"}},
      {"surface of two bodies",
       "a.geo",
       kBody + "Physical Surface(\"other\") = {1};",
       {},
       {"surface 1 near (0.5, 0.5)", "in two bodies, 'body' and 'other'"}},
      {"bodies of one name",
       "a.geo",
       kBody + square(2, "3") + "Physical Surface(\"b\", 5) = {2};\nPhysical Surface(\"b\", 6) = {1};",
       {},
       {"a.geo: "}},
      {"edge of no body",
       "a.geo",
       kBody + "Point(91) = {5, 5, 0}; Point(92) = {6, 5, 0}; Line(91) = {91, 92};\nPhysical Curve(\"loose\") = {91};",
       {},
       {"boundary 'loose': the edge near (5, 5) belongs to no body"}},
      {"third order",
       "a.geo",
       kBody + "Mesh.ElementOrder = 3;",
       {},
       {"Mesh.ElementOrder = 3", "expected 1 (linear) or 2 (quadratic)"}},
      {"third order that the .geo makes",
       "a.geo",
       kBody + "Mesh 2; SetOrder 3;",
       {},
       {"body 'body'", "not supported", "Triangle 10", "near ("}},
      {"third order boundary",
       "a.msh",
       msh(kUnitNodes, "1 3 2 1 1 1 2 3 4\n2 26 2 2 1 1 2 5 3\n"),
       {},
       {"boundary 'edge'", "not supported", "Line 4"}},
      {"out of the plane",
       "a.geo",
       "Point(1)={0,0,0}; Point(2)={1,0,0}; Point(3)={1,1,0.25};\nLine(1)={1,2}; Line(2)={2,3}; Line(3)={3,1}; Curve "
       "Loop(1)={1:3}; Plane Surface(1)={1};\nTransfinite Curve {1:3} = 2; Physical Surface(\"body\")={1};",
       {},
       {"body 'body' leaves the plane z = 0 near (1, 1), z = 0.25"}},
      {"plane off zero",
       "a.msh",
       msh("1 0 0 3\n2 1 0 3\n3 1 1 3\n4 0 1 3\n", "1 3 2 1 1 1 2 3 4\n"),
       {},
       {"leaves the plane z = 0", "z = 3"}},
      {"one of several bodies upright, as a box has it",
       "a.msh",
       msh("1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 1 0 1\n", "1 2 2 1 1 1 2 3\n2 2 2 1 1 1 2 5\n"),
       {},
       {"leaves the plane z = 0 near (1, 0), z = 1", "expected a plane mesh"}},
      {"no area",
       "a.msh",
       msh(kUnitNodes, "1 2 2 1 1 1 2 5\n"),
       {},
       {"body 'body': the cell near (1, 0) is degenerate"}},
      {"area of round-off",
       "a.msh",
       msh("1 0 0 0\n2 1 0 0\n3 2 1e-13 0\n", "1 2 2 1 1 1 2 3\n"),
       {},
       {"body 'body': the cell near (1, 3.33333e-14) is degenerate"}},
      {"a node twice in a cell", "a.msh", msh(kUnitNodes, "1 2 2 1 1 1 2 2\n"), {}, {"is degenerate"}},
      {"sides that cross",
       "a.msh",
       msh(kUnitNodes, "1 3 2 1 1 1 2 4 3\n"),
       {},
       {"the cell near (0.5, 0.5) is inverted: its sides cross"}},
      {"folded",
       "a.msh",
       msh("1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0.4 0.5 0\n", "1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n3 2 2 1 1 3 2 5\n"),
       {},
       {"is inverted: it runs the other way round", "near (0.8, 0.5)"}},
      {"in the plane x-z",
       "a.msh",
       msh("1 0 3 0\n2 1 3 0\n3 1 3 1\n4 0 3 1\n", "1 3 2 1 1 1 2 3 4\n"),
       {},
       {"the bodies lie in the plane x-z, y = 3.000000; expected them in x-y: exchange z and y"}},
      {"in the plane y-z",
       "a.msh",
       msh("1 0 0 0\n2 0 1 0\n3 0 1 1\n4 0 0 1\n", "1 3 2 1 1 1 2 3 4\n"),
       {},
       {"the bodies lie in the plane y-z, x = 0.000000; expected them in x-y: exchange z and x"}},
  };
}

TEST(BrokenMesh, IsRefusedInOneLineThatSaysWhere) {
  for (const BrokenMesh& broken : broken_meshes()) {
    const TemporaryFolder folder;
    const std::string file = folder.write(broken.file, broken.text);
    const std::string message = message_of<InputError>([&] { load_mesh(file, broken.parameters); });
    for (const std::string& said : broken.said) {
      EXPECT_NE(message.find(said), std::string::npos) << broken.name << ": not '" << said << "' in: " << message;
    }
    const bool of_parameter =
        broken.name.find(" parameter") != std::string::npos || broken.name.starts_with("parameter");
    const std::string key = of_parameter && !broken.name.ends_with("parameters") ? "mesh.parameters: " : "";
    EXPECT_EQ(message.rfind(key + file, 0), 0U) << broken.name << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << broken.name << ": " << message;
  }
}

TEST(BrokenMesh, NoSuchFile) {
  EXPECT_EQ(message_of<InputError>([] { load_mesh("/nowhere/a.geo", {}); }), "/nowhere/a.geo: no such file");
  EXPECT_EQ(message_of<InputError>([] { load_mesh("/nowhere/a.msh", {}); }), "/nowhere/a.msh: no such file");
}

TEST(BrokenMesh, UpsideDownAsAWholeIsNotBroken) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.msh", msh(kUnitNodes, "1 3 2 1 1 1 4 3 2\n2 2 2 1 1 2 3 5\n"));
  const Mesh mesh = load_mesh(file, {});
  ASSERT_EQ(mesh.cells.size(), 2U);
  EXPECT_EQ(mesh.nodes.rows(), 5);
}

TEST(BrokenMesh, CellsThatRunTheOtherWayRoundAreTurnedWithANote) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("a.msh", msh(kUnitNodes, "1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n3 2 2 1 1 2 3 5\n"));
  const Mesh mesh = load_mesh(file, {});
  ASSERT_EQ(mesh.notes.size(), 1u);
  EXPECT_EQ(mesh.notes[0].rfind("1 cells, the first of body 'body', ran the other way round", 0), 0u) << mesh.notes[0];
  for (const Cell& cell : mesh.cells) {
    const Vec2 a = mesh.nodes.row(cell.nodes[0]), b = mesh.nodes.row(cell.nodes[1]), c = mesh.nodes.row(cell.nodes[2]);
    EXPECT_GT((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x(), 0);
  }
}

TEST(MeshNames, GroupsWithOnlyATagAreNamedByIt) {
  const TemporaryFolder folder;
  const std::string geo = folder.write("a.geo", kBody + square(2, "3") +
                                                    "Physical Surface(7) = {2}; Physical Curve(8) = {12};\n"
                                                    "Physical Curve(\"top\", 9) = {13};");
  const Mesh mesh = load_mesh(geo, {});
  EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"body", "surface_7"}));
  EXPECT_EQ(boundary_names(mesh), (std::vector<std::string>{"curve_8", "top"}));
  EXPECT_TRUE(mesh.named_by_tag);
  EXPECT_FALSE(load_mesh(folder.write("b.geo", kBody + "Physical Curve(\"top\") = {13};"), {}).named_by_tag);
}

TEST(MeshNames, AMeshWithoutGroupsIsNamedByItsEntities) {
  const TemporaryFolder folder;
  const std::string text = msh(kUnitNodes, "1 3 2 0 4 1 2 3 4\n2 2 2 0 6 2 5 3\n3 1 2 0 5 1 2\n");
  const Mesh mesh = load_mesh(folder.write("a.msh", text), {});
  EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"surface_4", "surface_6"}));
  EXPECT_EQ(boundary_names(mesh), (std::vector<std::string>{"curve_5"}));
  EXPECT_TRUE(mesh.named_by_tag);
}

TEST(MeshNames, AGeometryWithoutGroupsIsNamedByItsEntities) {
  const TemporaryFolder folder;
  const std::string loose = "Point(91) = {5, 5, 0}; Point(92) = {6, 5, 0}; Line(91) = {91, 92};\n";
  const Mesh mesh = load_mesh(folder.write("a.geo", square(1, "0") + loose), {});
  EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"surface_1"}));
  EXPECT_EQ(mesh.boundaries.size(), 4U);  // none of the line that bounds nothing
  EXPECT_FALSE(mesh.boundaries[0].samples.empty());
  EXPECT_TRUE(mesh.named_by_tag);
  EXPECT_EQ(load_mesh(folder.write("b.geo", kBody), {}).boundaries.size(), 4U);  // of named bodies too
}

TEST(MeshNames, AllAreNamedForThoseWhoLookForNames) {
  const TemporaryFolder folder;
  const std::string geo = folder.write("a.geo", kBody + square(2, "3") + "Physical Curve(\"top\", 9) = {13};");
  EXPECT_THROW(load_mesh(geo, {}), InputError);  // surface 2 is of no body
  const Mesh mesh = load_all_named(geo, {});
  EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"body", "surface_2"}));
  ASSERT_EQ(mesh.boundaries.size(), 8U);
  EXPECT_EQ(mesh.boundaries[0].name, "top");
}

}  // namespace
}  // namespace mortise
