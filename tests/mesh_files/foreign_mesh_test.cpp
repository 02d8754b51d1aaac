// Meshes of universal files and of Nastran's bulk data.
#include <gmsh.h>
#include <gtest/gtest.h>

#include "gmsh/load_mesh.hpp"
#include "mesh/measures.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// As Salome writes it: two squares, of four and (of second order) eight nodes, the common side at x = 1.
const std::string nodes_unv = R"(    -1
   164
         1  SI: Meters (newton)         2
  1.0000000000000000E+0  1.0000000000000000E+0  1.0000000000000000E+0
    -1
    -1
  2411
         1         1         1        11
  0.0000000000000000D+00  0.0000000000000000D+00  0.0000000000000000D+00
         2         1         1        11
  1.0000000000000000D+00  0.0000000000000000D+00  0.0000000000000000D+00
         3         1         1        11
  2.0000000000000000D+00  0.0000000000000000D+00  0.0000000000000000D+00
         4         1         1        11
  0.0000000000000000D+00  1.0000000000000000D+00  0.0000000000000000D+00
         5         1         1        11
  1.0000000000000000D+00  1.0000000000000000D+00  0.0000000000000000D+00
         6         1         1        11
  2.0000000000000000D+00  1.0000000000000000D+00  0.0000000000000000D+00
    -1
)";
const std::string elements_unv = R"(    -1
  2412
         1        11         2         1         7         2
         0         1         1
         1         2
         2        11         2         1         7         2
         0         1         1
         2         3
         3        44         2         1         7         4
         1         2         5         4
         4        44         5         1         7         4
         2         3         6         5
    -1
)";
const std::string groups_unv = R"(    -1
  2467
         1         0         0         0         0         0         0         2
Bottom edge
         8         1         0         0         8         2         0         0
         2         0         0         0         0         0         0         1
Left
         8         3         0         0
         3         0         0         0         0         0         0         1
Right
         8         4         0         0
         4         0         0         0         0         0         0         2
Top
         7         4         0         0         7         5         0         0
         5         0         0         0         0         0         0         1
Tip
         7         6         0         0
    -1
)";

Mesh mesh_of(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  return load_mesh(folder.write(name, text), {});
}

std::string trouble(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  const std::string file = folder.write(name, text);
  const std::string message = message_of([&] { load_mesh(file, {}); });
  return message.starts_with(file) ? message.substr(file.size()) : message;
}

double length(const Mesh& mesh, const std::string& name) {
  return boundary_measures(mesh)[boundary_index(mesh, name)].size;
}

TEST(UniversalFile, GroupsAreBodiesCurvesAndPoints) {
  const Mesh mesh = mesh_of("a.unv", nodes_unv + elements_unv + groups_unv);
  EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"Left", "Right"}));
  EXPECT_EQ(boundary_names(mesh), (std::vector<std::string>{"Bottom edge", "Top"}));
  EXPECT_EQ(length(mesh, "Bottom edge"), 2);
  EXPECT_EQ(length(mesh, "Top"), 1);
  ASSERT_EQ(mesh.points.size(), 1u);
  EXPECT_EQ(mesh.points[0].name, "Tip");
  EXPECT_FALSE(mesh.named_by_tag);
}

TEST(UniversalFile, WithoutGroupsItsPropertiesAre) {
  const Mesh mesh = mesh_of("a.unv", nodes_unv + elements_unv);
  EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"surface_2", "surface_5"}));
  EXPECT_EQ(boundary_names(mesh), (std::vector<std::string>{"curve_2"}));
  EXPECT_TRUE(mesh.named_by_tag);
}

// Salome's descriptor of an edge is 22 with two nodes as with three.
TEST(UniversalFile, EdgesOfSecondOrderMayBeTaperedBeams) {
  for (const char* kind : {"22", "24"}) {
    const std::string more = "    -1\n  2411\n 7 1 1 11\n 2.0 0.5 0.0\n 8 1 1 11\n 1.0 0.5 0.0\n    -1\n";
    const Mesh mesh = mesh_of("a.unv", nodes_unv + more + "    -1\n  2412\n 1 " + kind + " 2 1 7 3\n 0 1 1\n 1 2 3\n" +
                                           " 2 42 5 1 7 6\n 1 2 3 7 6 8\n    -1\n");
    ASSERT_EQ(mesh.boundaries.size(), 1u) << kind;
    const Edge& edge = mesh.boundaries[0].edges[0];
    ASSERT_EQ(edge.node_count, 3) << kind;
    EXPECT_EQ(mesh.nodes(edge.nodes[2], 0), 1) << kind;
  }
}

TEST(UniversalFile, WhatCannotBeReadIsNamedWithItsLine) {
  EXPECT_EQ(trouble("a.unv", "hello\n"), ", line 1: expected -1, where a dataset begins; is this a universal file?");
  EXPECT_EQ(trouble("a.unv", "    -1\n  2411\n 1 1 1 11\n"),
            ", line 4: the dataset 2411 does not end; is the file cut off?");
  EXPECT_EQ(trouble("a.unv", "    -1\n  2411\n 1 1 1 11\n    -1\n"), ", line 3: the dataset ends within a record");
  EXPECT_EQ(trouble("a.unv", nodes_unv + "    -1\n  2412\n 1 91 1 1 7 3\n 1 2 9\n    -1\n"),
            ", line 24: there is no node 9");
  EXPECT_EQ(trouble("a.unv", nodes_unv + "    -1\n  2412\n 1 44 1 1 7 3\n 1 2 5\n    -1\n"),
            ", line 23: expected 4 nodes of an element of the kind 44, found 3");
  EXPECT_EQ(trouble("a.unv", nodes_unv + "    -1\n  2412\n 1 94 1 1 7 9\n 1 2 3 4 5 6 7 8\n 9\n    -1\n"),
            ", line 23: expected 4 nodes of an element of the kind 94, found 9; the format has no quadrilateral of 9 "
            "nodes: expected 8, or a .msh");
  EXPECT_EQ(trouble("a.unv", nodes_unv), ": no elements of plane bodies");
  EXPECT_EQ(trouble("a.unv", nodes_unv + nodes_unv + elements_unv), ", line 28: the node 1 is listed twice");
}

// Fields of 8 and of 16 characters, between commas, numbers without the e of their exponent.
const std::string bulk = R"(SOL 101
CEND
$ a comment
BEGIN BULK
GRID           1              0.      0.      0.
GRID*                  2                              1.              0.+
*                     0.
GRID,3,,2.0,0.,0.
GRID	4		0.	10.-1
grid,5,0,1.+0,1.E0
GRID,6,,.2+1,1.
CQUAD4         1       7       1       2       5       4
CQUAD4*                2               9               2               3*
*                      6               5
CBAR,11,3,1,2,0.,0.,1.
CROD,12,3,2,3
CELAS2,20,1.,1,1
PSHELL,7,1,.1
ENDDATA
CTRIA3,1
)";

TEST(BulkData, PropertiesAreBodiesAndCurves) {
  const Mesh mesh = mesh_of("a.bdf", bulk);
  EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"surface_7", "surface_9"}));
  EXPECT_EQ(boundary_names(mesh), (std::vector<std::string>{"curve_3"}));
  EXPECT_EQ(length(mesh, "curve_3"), 2);
  for (const Measure& body : body_measures(mesh)) EXPECT_NEAR(body.size, 1, 1e-15);
  EXPECT_EQ(mesh.notes, (std::vector<std::string>{"left out: 1 entry CELAS2"}));
  EXPECT_TRUE(mesh.named_by_tag);
}

TEST(BulkData, WithoutPropertiesPartsAreBodies) {
  const Mesh mesh = mesh_of("a.bdf",
                            "GRID,1,,0.,0.\nGRID,2,,1.,0.\nGRID,3,,1.,1.\nGRID,4,,0.,1.\nGRID,5,,2.,0.\n"
                            "GRID,6,,3.,0.\nGRID,7,,3.,1.\nCTRIA3,1,,1,2,3\nCTRIA3,2,,1,3,4\n"
                            "CTRIA3,3,,5,6,7\nCBAR,4,,1,2\n");
  EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"surface_1", "surface_2"}));
  EXPECT_TRUE(boundary_names(mesh).empty());
}

// Of coordinate systems, whose names may be blank, those that nodes are in and that are not x, y and z.
TEST(UniversalFile, NodesInOtherCoordinateSystemsAreRefused) {
  const auto file = [](const std::string& name, const std::string& kind, const std::string& axis,
                       const std::string& origin, const std::string& of_node) {
    return "-1\n2420\n1\nPart\n1 0 0\nCS1\n1. 0. 0.\n0. 1. 0.\n0. 0. 1.\n0. 0. 0.\n5 " + kind + " 0\n" + name +
           "\n1.0E+00 0. 0.\n" + axis + "\n0. 0. 1.\n" + origin + "\n-1\n-1\n2411\n1 " + of_node +
           " 1 11\n0. 0. 0.\n-1\n";
  };
  for (const std::string name : {"CS5", ""}) {
    const std::string refused = "the coordinate system 5 is not supported; expected x, y and z", none = "no elements";
    const auto said = [&](auto... parts) { return trouble("a.unv", file(name, parts...)); };
    EXPECT_NE(said("0", "0. 1. 0.", "0. -5.0D-01 0.", "5").find(refused), std::string::npos);
    EXPECT_NE(said("1", "0. 1. 0.", "0. 0. 0.", "5").find(refused), std::string::npos);
    EXPECT_NE(said("0", "0. 0. 1.", "0. 0. 0.", "5").find(refused), std::string::npos);
    EXPECT_NE(said("0", "0. 1. 0.", "0. -5.0D-01 0.", "1").find(none), std::string::npos);
    EXPECT_NE(said("0", "0. 1. 0.", "0. 0. 0.", "5").find(none), std::string::npos);
  }
}

TEST(BulkData, WhatCannotBeReadIsNamedWithItsLine) {
  EXPECT_EQ(trouble("a.bdf", "GRID,1,2,0.,0.\n"),
            ", line 1: GRID: the coordinate system 2 is not supported; expected none, or 0");
  EXPECT_EQ(trouble("a.bdf", "GRDSET,,0\nGRDSET,,5\n"),
            ", line 2: GRDSET: the coordinate system 5 is not supported; expected none, or 0");
  EXPECT_EQ(trouble("a.bdf", "GRID,1,,0.,0.\n=,*(1),=,*(1.),==\n=(3)\n"),
            ", line 2: replicated entries are not read; expected each entry written out");
  EXPECT_EQ(trouble("a.bdf", "GRID,1,,0.,1.2.3\n"), ", line 1: GRID: expected a coordinate, found '1.2.3'");
  EXPECT_EQ(trouble("a.nas", "GRID,1\nCTRIA3,1,1,1,2,3\n"), ", line 2: CTRIA3: there is no node 2");
  EXPECT_EQ(trouble("a.bdf", "GRID,1\n$\nGRID,1\n"), ", line 3: the node 1 is listed twice");
  EXPECT_EQ(trouble("a.bdf", "CTETRA,1,1,1,2,3,4\n"),
            ", line 1: CTETRA is not supported; expected CTRIA3, CQUAD4, CTRIA6, CQUAD8, CPLSTN or CPLSTS");
  EXPECT_EQ(trouble("a.bdf", "INCLUDE 'b.bdf'\n"), ", line 1: included files are not read; expected their text here");
  EXPECT_EQ(trouble("a.bdf", ""), ": no elements of plane bodies");
}

// Whatever gmsh writes of one mesh is one mesh: areas and lengths of first and second order.
TEST(ForeignMesh, WhatGmshWritesHasTheSameBodiesAndCurves) {
  for (const int order : {1, 2})
    for (const int recombine : {0, 1}) {
      const TemporaryFolder folder;
      const std::string geo = folder.write("a.geo", R"geo(
SetFactory("OpenCASCADE");
Disk(1) = {0, 0, 0, 1}; Rectangle(2) = {-2, -3, 0, 4, 2};
Physical Surface("disk", 7) = {1}; Physical Surface("base", 9) = {2};
Physical Curve("rim", 3) = {1}; Physical Curve("top", 4) = {4};
Mesh.SecondOrderIncomplete = 1;
)geo" + (recombine ? std::string("Recombine Surface{2};\n") : "") +
                                                        "Mesh.ElementOrder = " + std::to_string(order) + ";\n");
      gmsh::initialize();
      gmsh::option::setNumber("General.Terminal", 0);
      gmsh::open(geo);
      gmsh::model::mesh::generate(2);
      for (const char* ending : {"msh", "unv", "bdf"}) gmsh::write(folder.path("a.") + ending);
      gmsh::finalize();
      const Mesh msh = load_mesh(folder.path("a.msh"), {});
      const Mesh unv = load_mesh(folder.path("a.unv"), {});
      EXPECT_EQ(unv.bodies, msh.bodies);
      EXPECT_EQ(boundary_names(unv), (std::vector<std::string>{"rim", "top"}));
      for (const char* name : {"rim", "top"}) EXPECT_NEAR(length(unv, name), length(msh, name), 1e-12);
      const Mesh bdf = load_mesh(folder.path("a.bdf"), {});
      EXPECT_EQ(bdf.bodies.size(), 2u);
      for (std::size_t b = 0; b < 2; ++b) {
        EXPECT_NEAR(body_measures(unv)[b].size, body_measures(msh)[b].size, 1e-12);
        EXPECT_NEAR(body_measures(bdf)[b].size, body_measures(msh)[b].size, 3e-5);  // six digits, cut off
      }
    }
}

TEST(ForeignMesh, FormatsThatAreNotReadSayWhatToDo) {
  EXPECT_EQ(
      trouble("a.med", ""),
      ": a mesh file ends in .geo or .msh (or .inp of Abaqus or CalculiX, .unv, .bdf or .nas of Nastran); save it "
      "as .unv in Salome (Export, UNV file), which keeps its groups");
  expect_contains(trouble("a.cgns", ""), "; save it as .msh, .unv or .bdf by the program that made it");
}

}  // namespace
}  // namespace mortise::test
