// Curves that gmsh draws, sampled edge by edge as a mesh is loaded.
#include <gtest/gtest.h>

#include "gmsh/load_mesh.hpp"
#include "gmsh/write_msh.hpp"
#include "mesh/curve.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

using test::TemporaryFolder;

// A disc of two arcs, one of them named backwards, or of one closed curve.
std::string disc(bool one_curve) {
  return std::string(one_curve ? "SetFactory(\"OpenCASCADE\"); Disk(1) = {3, 4, 0, 2};\n"
                               : "Point(1) = {3, 4, 0}; Point(2) = {5, 4, 0}; Point(3) = {1, 4, 0};\n"
                                 "Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 2};\n"
                                 "Curve Loop(1) = {1, 2}; Plane Surface(1) = {1};\n") +
         "Physical Surface(\"disc\") = {1}; Physical Curve(\"rim\") = {" + (one_curve ? "1" : "1, -2") +
         "}; Mesh.CharacteristicLengthMax = 0.7;\n";
}

TEST(DrawnCurves, SamplesLieOnTheCurveFromNodeToNode) {
  for (const bool one_curve : {false, true})
    for (const char* order :
         {"Mesh.ElementOrder = 1;", "Mesh.ElementOrder = 2;", "Mesh.ElementOrder = 2; Mesh.SecondOrderLinear = 1;"}) {
      const TemporaryFolder folder;
      const Mesh mesh = load_mesh(folder.write("a.geo", disc(one_curve) + order), {}, {});
      const Boundary& rim = mesh.boundaries[0];
      EXPECT_EQ(rim.undrawn, "");
      ASSERT_EQ(rim.samples.size(), rim.edges.size());
      const Curve curve = contact_curve(mesh, 0);
      ASSERT_EQ(curve.samples.size(), curve.edges.size());
      for (std::size_t e = 0; e < curve.edges.size(); ++e) {
        ASSERT_EQ(curve.samples[e].pieces.size(), 1u);
        const auto& x = curve.samples[e].pieces[0].places;
        EXPECT_LE((x.front() - mesh.nodes.row(curve.edges[e].nodes[0]).transpose()).norm(), 1e-9);
        EXPECT_LE((x.back() - mesh.nodes.row(curve.edges[e].nodes[1]).transpose()).norm(), 1e-9);
        for (const Vec2& place : x) EXPECT_NEAR((place - Vec2(3, 4)).norm(), 2, 1e-14);
        const Vec2 half = (x.front() + x.back()) / 2 - Vec2(3, 4);  // the middle one lies halfway, not round the disc
        EXPECT_LE((x[4] - Vec2(3, 4) - 2 * half.normalized()).norm(), 1e-9);
      }
    }
}

TEST(DrawnCurves, AMeshThatIsMergedHasNone) {
  const TemporaryFolder folder;
  const std::string geo = folder.write("a.geo", disc(false));
  write_msh(load_mesh(geo, {}), folder.path("a.msh"));
  for (const std::string& file : {folder.path("a.msh"), folder.write("b.geo", "Merge \"a.msh\";\n")}) {
    const Mesh mesh = load_mesh(file, {}, {});
    EXPECT_TRUE(mesh.boundaries[0].samples.empty()) << file;
    EXPECT_EQ(mesh.boundaries[0].undrawn, "") << file;
  }
}

TEST(DrawnCurves, AMeshThatDoesNotFollowItsGeometryIsToldWithAPlace) {
  const TemporaryFolder folder;
  write_msh(load_mesh(folder.write("a.geo", disc(false)), {}), folder.path("a.msh"));
  std::string drawn = disc(false);  // with the tags of the mesh, which has both arcs as one curve
  drawn.replace(drawn.find("\"rim\""), 5, "\"rim\", 1");
  const Mesh mesh = load_mesh(folder.write("b.geo", drawn + "Merge \"a.msh\";\n"), {}, {});
  EXPECT_TRUE(mesh.boundaries[0].samples.empty());
  EXPECT_EQ(mesh.boundaries[0].undrawn.rfind("the mesh does not follow it near (", 0), 0u)
      << mesh.boundaries[0].undrawn;
}

}  // namespace
}  // namespace mortise
