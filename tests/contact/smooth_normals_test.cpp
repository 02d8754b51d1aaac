// The normals of the curve behind a mesh: exact on lines and arcs however the vertices are spaced.
#include "contact/smooth_normals.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mortise {
namespace {

// An open curve through `vertices`, all of whose edges face another.
struct CircleChain {
  Points nodes;
  Curve curve{0, 0, {}, {}, false};
  std::vector<char> faces;

  explicit CircleChain(const std::vector<Vec2>& vertices) : nodes(Eigen::Index(vertices.size()), 2) {
    for (std::size_t i = 0; i < vertices.size(); ++i) nodes.row(i) = vertices[i].transpose();
    for (int e = 0; e + 1 < int(vertices.size()); ++e) {
      curve.edges.push_back({2, {e, e + 1, -1}});
      faces.push_back(1);
    }
  }
  std::vector<ContactNormal> normals() const { return smooth_normals(nodes, curve, 1, faces); }
};

TEST(SmoothNormals, AreExactOnAnArcOfUnevenEdges) {
  std::vector<Vec2> vertices;
  for (const double angle : {0.0, 0.1, 0.13, 0.3, 0.45, 0.5})
    vertices.push_back(Vec2(2, 1) + 3 * Vec2(std::cos(angle), std::sin(angle)));
  const CircleChain chain(vertices);
  const std::vector<ContactNormal> found = chain.normals();
  ASSERT_EQ(found.size(), vertices.size());
  for (const ContactNormal& n : found) EXPECT_LE((n.normal - (n.position - Vec2(2, 1)) / 3).norm(), 1e-12);
  EXPECT_NEAR(edge_error(chain.nodes, chain.curve), 0.16 * 0.16 / 8,
              1e-12);  // the edges of 0.17 and 0.15 turn by half the sum of both
}

TEST(SmoothNormals, AtACornerAreThoseOfBothEdges) {
  const CircleChain chain({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 3}});
  const std::vector<ContactNormal> found = chain.normals();
  ASSERT_EQ(found.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_LE((found[k].normal - (k < 3 ? Vec2(0, -1) : Vec2(1, 0))).norm(), 1e-14);
  EXPECT_EQ(edge_error(chain.nodes, chain.curve), 0);
}

TEST(SmoothNormals, StandOnlyWhereTheCurveFacesTheOther) {
  CircleChain chain({{0, 0}, {1, 0}, {2, 0}, {3, 0}});
  chain.faces = {0, 1, 0};
  EXPECT_EQ(chain.normals().size(), 2U);
}

}  // namespace
}  // namespace mortise
