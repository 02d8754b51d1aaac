#include "mesh_files/inp_file.hpp"

#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "gmsh/load_mesh.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

using test::message_of;
using test::TemporaryFolder;

/// Two unit squares side by side, of four nodes each, with a common side at x = 1.
const std::string nodes = R"(*Heading
 two squares
** a comment
*NODE, NSET=Nall
1, 0., 0.
2, 1., 0.
3, 2., 0.
4, 0., 1.d0
5, +1., 1., 0.
6, 2., 1., 0.
)";
const std::string cells = R"(*ELEMENT, TYPE=CPS4R, ELSET=Eall
10, 1, 2, 5, 4
20, 2, 3,
 6, 5
)";
const std::string sets = R"(*ELSET, ELSET=Left
10
*Elset, elset=Right, generate
20, 20, 1
*NSET, NSET=Bottom, GENERATE
1, 3
*NSET, NSET=Tip
6
*NSET, NSET=Sides
1, 4, 3, 6
*SURFACE, NAME=Top, TYPE=ELEMENT
Eall, S3
)";

Mesh inp_mesh(const std::string& text) {
  const TemporaryFolder folder;
  return load_mesh(folder.write("a.inp", text), {});
}

double inp_length(const Mesh& mesh, const std::string& name) {
  double sum = 0;
  for (const Edge& edge : mesh.boundaries[boundary_index(mesh, name)].edges)
    sum += (mesh.nodes.row(edge.nodes[0]) - mesh.nodes.row(edge.nodes[1])).norm();
  return sum;
}

TEST(InpFile, SetsAreBodiesCurvesAndPoints) {
  const Mesh mesh = inp_mesh(nodes + cells + sets);
  EXPECT_EQ(mesh.nodes.rows(), 6);
  EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"Left", "Right"}));
  EXPECT_EQ(boundary_names(mesh), (std::vector<std::string>{"Top", "Nall", "Bottom", "Sides"}));
  EXPECT_EQ(inp_length(mesh, "Top"), 2);
  EXPECT_EQ(inp_length(mesh, "Bottom"), 2);
  EXPECT_EQ(inp_length(mesh, "Sides"), 2);
  EXPECT_EQ(inp_length(mesh, "Nall"), 7);  // the common side is on the boundary of both bodies
  ASSERT_EQ(mesh.points.size(), 1u);
  EXPECT_EQ(mesh.points[0].name, "Tip");
  EXPECT_EQ(mesh.nodes.row(mesh.points[0].nodes.at(0)), Eigen::RowVector2d(2, 1));
  EXPECT_FALSE(mesh.named_by_tag);
  EXPECT_TRUE(mesh.notes.empty());
}

TEST(InpFile, SolidSectionsMakeTheBodies) {
  const Mesh mesh = inp_mesh(nodes + cells + sets + "*SOLID SECTION, ELSET=EALL, MATERIAL=steel\n*STEP\n*STATIC\n");
  EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"Eall"}));
  EXPECT_EQ(inp_length(mesh, "Nall"), 6);
  EXPECT_NE(message_of<InputError>([] {
              inp_mesh(nodes + cells + sets + "*SOLID SECTION, ELSET=Left, MATERIAL=steel\n");
            }).find("the element 20 is in no body"),
            std::string::npos);
  EXPECT_NE(message_of<InputError>([] {
              inp_mesh(nodes + cells + sets +
                       "*SOLID SECTION, ELSET=Left, MATERIAL=a\n*SOLID SECTION, ELSET=Eall, MATERIAL=a\n");
            }).find("the element 10 is in two bodies, 'Left' and 'Eall'"),
            std::string::npos);
}

TEST(InpFile, WithoutSetsConnectedPartsAreTheBodies) {
  const Mesh mesh = inp_mesh(nodes + "7, 5, 0\n8, 6, 0\n9, 5, 1\n*ELEMENT, TYPE=CPE4\n1, 1, 2, 5, 4\n2, 2, 3, 6, 5\n" +
                             "*ELEMENT, TYPE=CPE3\n3, 7, 8, 9\n");
  EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"surface_1", "surface_2"}));
  EXPECT_TRUE(mesh.named_by_tag);
}

TEST(InpFile, ASetOfPartsThatHangApartIsABodyForEach) {
  const Mesh mesh =
      inp_mesh(nodes + "7, 5, 0\n8, 6, 0\n9, 5, 1\n" + cells + "*ELEMENT, TYPE=CPS3, ELSET=Eall\n3, 7, 8, 9\n");
  EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"Eall_1", "Eall_2"}));
  EXPECT_TRUE(mesh.named_by_tag);
  EXPECT_EQ(mesh.cells.back().body, 1);
  EXPECT_EQ(mesh.cells.back().kind, CellKind::tri3);
}

TEST(InpFile, EveryKindOfPlaneElement) {
  const std::string eight =
      "*NODE\n1,0,0\n2,2,0\n3,2,2\n4,0,2\n5,1,0\n6,2,1\n7,1,2\n8,0,1\n9,1,1\n*NSET,NSET=low\n1,2,5\n";
  const std::string triangle = "\n1, 1, 2, 4, 5, 9, 8\n";
  using enum CellKind;
  for (const char* family : {"CPS", "CPE", "CAX", "cax", "S", "M3D"}) {
    const std::string type = "*ELEMENT, ELSET=E, TYPE=" + std::string(family);
    for (const auto& [rest, kind] :
         std::vector<std::pair<std::string, CellKind>>{{"3\n1, 1, 2, 3\n", tri3},
                                                       {"4\n1, 1, 2, 3, 4\n", quad4},
                                                       {"4R\n1, 1, 2, 3, 4\n", quad4},
                                                       {"6" + triangle, tri6},
                                                       {"6M" + triangle, tri6},
                                                       {"8\n1,1,2,3,4,5,6,7,8\n", quad8},
                                                       {"8R\n1,1,2,3,4,5,6,\n7,8\n", quad8}}) {
      const Mesh mesh = inp_mesh(eight + type + rest);
      ASSERT_EQ(mesh.cells.size(), 1u);
      EXPECT_EQ(mesh.cells[0].kind, kind);
      EXPECT_EQ(mesh.bodies, std::vector<std::string>{"E"});
      EXPECT_EQ(inp_length(mesh, "low"), 2);
      const Edge& low = mesh.boundaries[0].edges.at(0);
      EXPECT_EQ(low.node_count, is_quadratic(kind) ? 3 : 2);
      if (low.node_count == 3) {
        EXPECT_EQ(mesh.nodes.row(low.nodes[2]), Eigen::RowVector2d(1, 0));
      }
    }
  }
}

TEST(InpFile, SurfacesByFacesAndByAllThatIsFree) {
  const Mesh mesh = inp_mesh(nodes + cells +
                             "*SURFACE, NAME=faces\n10, S1\n20, s2\n*SURFACE, NAME=skin\nEall,\n"
                             "*SURFACE, TYPE=NODE, NAME=upper\n4\n5\n6\n");
  EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"Eall"}));
  EXPECT_EQ(inp_length(mesh, "faces"), 2);
  EXPECT_EQ(inp_length(mesh, "skin"), 6);
  EXPECT_EQ(inp_length(mesh, "upper"), 2);
}

TEST(InpFile, LinesOfADeckThatGmshWroteAreCurves) {
  const Mesh mesh = inp_mesh(nodes + cells + "*ELEMENT, TYPE=T3D2, ELSET=Line1\n30, 1, 2\n31, 2, 3\n");
  EXPECT_EQ(inp_length(mesh, "Line1"), 2);
}

TEST(InpFile, ALineOfThreeNodesHasItsMiddleSecond) {
  const Mesh mesh = inp_mesh(
      "*NODE\n1,0,0\n2,2,0\n3,2,2\n4,0,2\n5,1,0\n6,2,1\n7,1,2\n8,0,1\n"
      "*ELEMENT, TYPE=CPS8, ELSET=Eall\n10, 1, 2, 3, 4, 5, 6, 7, 8\n*ELEMENT, TYPE=T2D3, ELSET=Low\n30, 1, 5, 2\n");
  ASSERT_EQ(boundary_names(mesh), (std::vector<std::string>{"Low"}));
  const Edge& edge = mesh.boundaries[0].edges.at(0);
  EXPECT_EQ(edge.node_count, 3);
  EXPECT_EQ(Vec2(mesh.nodes.row(edge.nodes[2])), Vec2(1, 0));
  EXPECT_EQ(inp_length(mesh, "Low"), 2);
}

// As meshio 5 writes plane meshes: shells, lines of three nodes as B33H with the middle one last, members of sets as
// real numbers, and sets of gmsh's own that are none.
TEST(InpFile, DecksOfMeshioHaveTheirNames) {
  const std::string eight = "*NODE\n1,0,0,0\n2,2,0,0\n3,2,2,0\n4,0,2,0\n5,1,0,0\n6,2,1,0\n7,1,2,0\n8,0,1,0\n9,1,1,0\n",
                    sets =
                        "*ELSET, ELSET=low\n1.0\n*ELSET, ELSET=gmsh:bounding_entities\n0,-1\n*ELSET, ELSET=body\n2.0";
  for (const auto& [line, cell] : std::vector<std::pair<std::string, std::string>>{
           {"B33H\n1,1,2,5\n", "S8R5\n2,1,2,3,4,5,6,7,8\n"}, {"B31H\n1,1,2\n", "R3D4\n2,1,2,3,4\n"}}) {
    const Mesh mesh = inp_mesh(eight + "*ELEMENT, TYPE=" + line + "*ELEMENT, TYPE=" + cell + sets);
    EXPECT_EQ(mesh.bodies, std::vector<std::string>{"body"});
    EXPECT_EQ(boundary_names(mesh), std::vector<std::string>{"low"});
    EXPECT_EQ(inp_length(mesh, "low"), 2);
  }
  for (const auto& [cell, kind] : std::vector<std::pair<std::string, CellKind>>{
           {"R3D3\n1,1,2,3\n", CellKind::tri3}, {"STRI65\n1,1,2,4,5,9,8\n", CellKind::tri6}})
    EXPECT_EQ(inp_mesh(eight + "*ELEMENT, TYPE=" + cell).cells.at(0).kind, kind);
}

TEST(InpFile, SpringsAreLeftOutWithANote) {
  const Mesh mesh = inp_mesh(nodes + cells + "*ELEMENT, TYPE=SPRINGA, ELSET=springs\n30, 1, 2\n31, 2, 3\n");
  EXPECT_EQ(mesh.notes, std::vector<std::string>{"left out: 2 elements of the kind SPRINGA"});
}

TEST(InpFile, SetsOfSetsAndOnePart) {
  const Mesh mesh =
      inp_mesh("*PART, NAME=p\n" + nodes + cells + sets +
               "*NSET, NSET=both\nBottom, TIP\n*NSET, NSET=right, ELSET=Right\n*END PART\n*ASSEMBLY, NAME=a\n"
               "*INSTANCE, NAME=p-1, PART=p\n*END INSTANCE\n*NSET, NSET=low, INSTANCE=p-1\n1, 2\n"
               "*NSET, NSET=left\np-1.1, p-1.4\n*END ASSEMBLY\n");
  EXPECT_EQ(inp_length(mesh, "both"), 3);
  EXPECT_EQ(inp_length(mesh, "right"), 4);
  EXPECT_EQ(inp_length(mesh, "low"), 1);
  EXPECT_EQ(inp_length(mesh, "left"), 1);
}

TEST(InpFile, SaysWhichCouplingsAreLeftOut) {
  const TemporaryFolder folder;
  const std::string text = nodes + cells + "*TIE, NAME=t\na, b\n*SYSTEM\n*EQUATION\n2\n*EQUATION\n2\n*STEP\n";
  EXPECT_EQ(load_mesh(folder.write("a.inp", text), {}).notes,
            (std::vector<std::string>{"left out: 2 cards *EQUATION", "left out: 1 card *TIE"}));
}

TEST(InpFile, SaysWhatIsWrongAndWhere) {
  const std::string all = nodes + cells;
  for (const auto& [text, said] : std::vector<std::pair<std::string, std::string>>{
           {"", "no elements of plane bodies"},
           {"hello\n", "line 1: this is no deck of Abaqus or CalculiX: expected a card such as *NODE, found 'hello'"},
           {nodes, "no elements of plane bodies"},
           {nodes + "2, 1, 1\n", "line 11: the node 2 is listed twice"},
           {nodes + "7, x, 1\n", "line 11: expected a coordinate, found 'x'"},
           {nodes + "7, nan, 1\n", "line 11: expected a coordinate, found 'nan'"},
           {nodes + "0, 1, 1\n", "line 11: expected a node's number, a number > 0, found '0'"},
           {"*NODE, SYSTEM=C\n1, 1, 0\n", "line 1: *NODE: SYSTEM and INPUT are not supported"},
           {all + "20, 1, 2, 3, 4\n", "line 15: the element 20 is listed twice"},
           {all + "30, 1, 2, 3, 9\n", "line 15: there is no node 9"},
           {all + "30, 1, 2, 3\n", "line 15: the element 30 has 3 nodes; expected 4"},
           {all + "30, 1, 2, 3, 4, 5\n", "line 15: the element 30 has 5 nodes; expected 4"},
           {all + "*ELEMENT, TYPE=C3D8\n1, 1\n", "line 15: *ELEMENT: TYPE=C3D8 is not supported; expected CPS"},
           {all + "*ELEMENT, TYPE=CPS5\n", "TYPE=CPS5 is not supported"},
           {all + "*ELEMENT\n", "TYPE= is not supported"},
           {all + "*NSET, NSET=a\n99\n", "line 16: there is no node 99"},
           {all + "*NSET, NSET=a\nb\n", "line 16: there is no set of nodes 'b' before this line"},
           {all + "*ELSET, ELSET=a, GENERATE\n5\n", "line 16: expected the first number, the last and the step"},
           {all + "*ELSET, ELSET=a, GENERATE\n1, 9223372036854775807, 1\n", "line 16: expected a last number"},
           {all + "*ELSET, ELSET=a, GENERATE\n9, 5, 1\n", "line 16: expected a last number"},
           {all + "*ELSET, ELSET=a, GENERATE\n1, 5, 0\n", "line 16: expected the step, a number > 0, found '0'"},
           {all + "*SURFACE, NAME=a\nEall, S5\n", "line 16: the element 10 has no face 'S5'; expected S1 to S4"},
           {all + "*SURFACE, NAME=a\nnone, S1\n", "line 16: there is no set of elements 'none' before this line"},
           {all + "*SURFACE\nEall, S1\n", "line 15: *SURFACE: expected NAME="},
           {all + "*SOLID SECTION, ELSET=none\n", "line 15: there is no set of elements 'none' before this line"},
           {all + "*SOLID SECTION\n", "line 15: *SOLIDSECTION: expected ELSET="},
           {all + "*NGEN\n1, 2\n", "line 15: *NGEN: is not supported; expected all nodes and elements to be listed"},
           {"*INCLUDE, INPUT=mesh.inp\n", "line 1: *INCLUDE: included files are not read"},
           {"*PART, NAME=a\n*END PART\n*PART, NAME=b\n", "line 3: *PART: a second part"},
           {"*SYSTEM\n0, 1, 0\n", "line 1: *SYSTEM: is not supported; expected nodes in x, y and z"},
           {all + "*ELEMENT, TYPE=DC2D4\n30, 1, 2, 3, 4\n*SURFACE, NAME=a\n30, S1\n",
            "line 18: the element 30 is of a kind that is left out"},
           {"*INSTANCE, NAME=a\n1, 0, 0\n", "line 1: *INSTANCE: a part that is moved"},
       }) {
    const TemporaryFolder folder;
    const std::string file = folder.write("a.inp", text);
    const std::string message = message_of<InputError>([&] { load_mesh(file, {}); });
    EXPECT_NE(message.find(said), std::string::npos) << "not '" << said << "' in: " << message;
    EXPECT_EQ(message.rfind(file, 0), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(InpFile, DamagedDecksAreReadOrRefused) {
  const std::string whole = nodes + cells + sets + "*SOLID SECTION, ELSET=Eall\n";
  const TemporaryFolder folder;
  int refused = 0;
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const char by : {',', '*', '\n', '9', '='}) {
      std::string damaged = whole;
      damaged[at] = by;
      try {
        load_mesh(folder.write("a.inp", damaged), {});
      } catch (const InputError&) {
        ++refused;
      }
    }
  EXPECT_GT(refused, 100);  // anything else that is thrown fails the test
}

}  // namespace
}  // namespace mortise
