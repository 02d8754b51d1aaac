#include "fem/arc_length.hpp"

#include <gtest/gtest.h>

#include "mesh/grid.hpp"
#include "support/two_plates.hpp"

namespace mortise {
namespace {

TEST(ArcLength, RunsFromTheEndWithTheSmallerX) {
  const Mesh mesh = testing_meshes::plate(CellKind::quad8, 4, 3);
  for (const char* name : {"bottom", "top"}) {  // seen from the body one runs with x, the other against it
    const Curve curve = contact_curve(mesh, boundary_index(mesh, name));
    const ArcLength s(mesh.nodes, curve);
    for (const int node : curve_nodes(curve)) EXPECT_NEAR(s.at_node(node), mesh.nodes(node, 0), 1e-13) << name;
    for (int e = 0; e < 4; ++e) {
      const Vec2 x = edge_point(mesh.nodes, curve.edges[e], 0.3).position;
      EXPECT_NEAR(s.at(e, 0.3), x.x(), 1e-13);
      EXPECT_NEAR(s.at(e, x), x.x(), 1e-13);
    }
  }
  const Curve left = contact_curve(mesh, boundary_index(mesh, "left"));  // the same x: from the smaller y
  const ArcLength s(mesh.nodes, left);
  for (const int node : curve_nodes(left)) EXPECT_NEAR(s.at_node(node), mesh.nodes(node, 1), 1e-13);
}

TEST(ArcLength, OfACurvedEdgeIsTheSameByPlaceAndByCoordinate) {
  test::TwoPlates plates;
  plates.height = [](double x) { return 0.3 + x * x; };
  const Mesh mesh = test::mesh_of(plates);
  const Curve curve = contact_curve(mesh, boundary_index(mesh, "lower_contact"));
  const ArcLength s(mesh.nodes, curve);
  for (int e = 0; e < int(curve.edges.size()); ++e)
    for (const double xi : {-1.0, -0.4, 0.0, 0.7, 1.0}) {
      const Vec2 x = edge_point(mesh.nodes, curve.edges[e], xi).position;
      EXPECT_NEAR(s.at(e, x), s.at(e, xi), 1e-13);
      // Of the parabola y = x^2; the 3-node edges follow it exactly.
      EXPECT_NEAR(s.at(e, xi), (2 * x.x() * std::sqrt(1 + 4 * x.x() * x.x()) + std::asinh(2 * x.x())) / 4, 1e-12);
    }
}

TEST(ArcLength, OfAClosedCurveBeginsAtItsLeftmostNode) {
  const Mesh mesh = testing_meshes::plate(CellKind::tri3, 2, 1);
  const Curve curve = contact_curve(mesh, boundary_index(mesh, "all"));
  ASSERT_TRUE(curve.closed);
  const ArcLength s(mesh.nodes, curve);
  for (const int node : curve_nodes(curve)) {
    const double x = mesh.nodes(node, 0), y = mesh.nodes(node, 1);
    const double expected = y == 0 ? x : x == 2 ? 2 + y : 3 + 2 - x;  // counter-clockwise from (0, 0)
    EXPECT_NEAR(s.at_node(node), expected, 1e-13);
  }
}

// Coordinates that doubles have exactly there as well.
TEST(Edges, HaveTheSameTangentAndLengthFarFromTheOrigin) {
  const Edge edge{3, {0, 1, 2}};
  Points nodes = (Points(3, 2) << 1, 0, 0, 0, 0.5, 0.125).finished();
  const Vec2 tangent = edge_point(nodes, edge, 0.3).tangent;
  const double length = edge_length(nodes, edge);
  nodes.array() += 4294967296;  // 2^32
  EXPECT_EQ((edge_point(nodes, edge, 0.3).tangent - tangent).norm(), 0);
  EXPECT_EQ(edge_length(nodes, edge), length);
}

}  // namespace
}  // namespace mortise
