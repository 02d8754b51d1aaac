// Which places of bodies are singular by themselves.
#include "contact/body_corners.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "support/two_plates.hpp"
#include "support/wedges.hpp"

namespace mortise {
namespace {

using test::bonded_exponent;
using test::bonded_exponent_inside;
using test::wedge_exponent;

constexpr double degree = std::numbers::pi / 180;
const ElasticLaw steel = elastic_law(210e9, 0.3, {Plane::strain});

Wedge wedge_of(double degrees, double stiffness = 1) {
  return wedge(degrees * degree, elastic_law(stiffness, 0.3, {Plane::strain}));
}

// Squares of side 1 around the origin, so many quarters, each a body of its own.
Mesh quarters(int count) {
  const int x[] = {1, 1, 0, -1, -1, -1, 0, 1}, y[] = {0, 1, 1, 1, 0, -1, -1, -1};
  Mesh mesh;
  mesh.nodes.resize(count == 4 ? 9 : 2 * count + 2, 2);
  mesh.nodes.row(0).setZero();
  for (Eigen::Index i = 1; i < mesh.nodes.rows(); ++i) mesh.nodes.row(i) << x[i - 1], y[i - 1];
  for (int q = 0; q < count; ++q) {
    const int first = 2 * q + 1;
    mesh.cells.push_back({CellKind::quad4, q, {0, first, first + 1, q == 3 ? 1 : first + 2}});
    mesh.bodies.emplace_back(1, char(97 + q));
  }
  return mesh;
}

std::vector<BodyCorner> corners_of(const Mesh& mesh, const Constraints& constraints,
                                   const std::vector<ElasticLaw>& laws) {
  TipTable tips;
  return body_corners({mesh, SideTable(mesh), TiedVertices(), constraints, laws, tips});
}

double exponent_at(const Mesh& mesh, int node, const Constraints& constraints, const std::vector<ElasticLaw>& laws) {
  TipTable tips;
  return corner_exponent({mesh, SideTable(mesh), TiedVertices(), constraints, laws, tips}, node);
}

std::vector<BodyCorner> corners_of(const Mesh& mesh, const std::vector<ElasticLaw>& laws) {
  return corners_of(mesh, no_constraints(mesh), laws);
}

// By the direction in which all of its nodes are held: across the face it is a line of symmetry, along it one of
// antisymmetry.
TEST(BodyCorners, AFaceIsWhatHoldsAllOfItsNodes) {
  const Mesh mesh = quarters(1);
  const Edge along_x{2, {0, 1, -1}}, along_y{2, {1, 2, -1}};
  const auto face = [&](const Edge& edge, const std::vector<std::pair<int, int>>& held) {
    Constraints constraints = no_constraints(mesh);
    for (const auto& [node, component] : held) constraints.fixed[2 * node + component] = 1;
    return face_of(mesh.nodes, edge, constraints);
  };
  EXPECT_EQ(face(along_x, {}), Face::free);
  EXPECT_EQ(face(along_x, {{0, 0}, {0, 1}}), Face::free);
  EXPECT_EQ(face(along_x, {{0, 1}, {1, 1}}), Face::symmetric);
  EXPECT_EQ(face(along_x, {{0, 0}, {1, 0}}), Face::antisymmetric);
  EXPECT_EQ(face(along_y, {{1, 1}, {2, 1}}), Face::antisymmetric);
  EXPECT_EQ(face(along_y, {{1, 0}, {2, 0}}), Face::symmetric);
  EXPECT_EQ(face(along_x, {{0, 0}, {0, 1}, {1, 0}, {1, 1}}), Face::clamped);
  EXPECT_EQ(face(along_x, {{0, 0}, {0, 1}, {1, 1}}), Face::symmetric);  // one node held in both
  EXPECT_EQ(face(along_x, {{0, 0}, {1, 1}}), Face::free);
}

TEST(BodyCorners, AreThoseThatTurnInwards) {
  EXPECT_TRUE(corners_of(quarters(1), {steel}).empty());
  EXPECT_TRUE(corners_of(quarters(2), {steel, steel}).empty());
  EXPECT_TRUE(corners_of(quarters(4), std::vector(4, steel)).empty());
  const auto found = corners_of(quarters(3), std::vector(3, steel));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].node, 0);
  EXPECT_NEAR(found[0].exponent, 0.5444837367, 1e-4);  // Williams (1952)
}

// A cut of no width: the faces are in one place, the cells between them all around.
TEST(BodyCorners, AreTheTipsOfCracks) {
  Mesh mesh = quarters(4);
  const int end = int(mesh.nodes.rows());
  mesh.nodes.conservativeResize(end + 1, 2);
  mesh.nodes.row(end) = mesh.nodes.row(mesh.cells[0].nodes[1]);  // on the common side of the first and the last cell
  for (int a = 0; a < node_count(mesh.cells[3].kind); ++a)
    if (mesh.cells[3].nodes[a] == mesh.cells[0].nodes[1]) mesh.cells[3].nodes[a] = end;
  const auto found = corners_of(mesh, std::vector(4, steel));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].node, 0);
  EXPECT_NEAR(found[0].exponent, 0.5, 1e-4);
  EXPECT_NEAR(exponent_at(mesh, 0, no_constraints(mesh), std::vector(4, steel)), 0.5, 1e-9);
}

TEST(BodyCorners, AreWhereASupportEnds) {
  const Mesh mesh = quarters(2);
  Constraints constraints = no_constraints(mesh);
  for (const int dof : {0, 1, 2, 3}) prescribe(mesh, "end", dof, 0, constraints);
  const auto found = corners_of(mesh, constraints, {steel, steel});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].node, 0);
  EXPECT_NEAR(found[0].exponent, 0.5, 1e-4);  // Muskhelishvili (1953)
  EXPECT_EQ(found[1].node, 1);
  EXPECT_NEAR(found[1].exponent, 0.7111729, 1e-4);  // clamped and free at a right angle
}

TEST(BodyCorners, AreWhereMaterialsMeet) {
  const ElasticLaw soft = elastic_law(1, 0.3, {Plane::strain}), stiff = elastic_law(100, 0.3, {Plane::strain});
  const auto ends = corners_of(quarters(2), {soft, stiff});  // a joint of two blocks ends at free sides
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_EQ(ends[0].node, 0);
  EXPECT_EQ(ends[1].node, 3);
  EXPECT_NEAR(ends[0].exponent, ends[1].exponent, 1e-12);
  const auto inside = corners_of(quarters(4), {stiff, soft, soft, soft});
  ASSERT_FALSE(inside.empty());
  EXPECT_EQ(inside[0].node, 0);
  const std::vector<Wedge> all_around{wedge(90 * degree, stiff), wedge(270 * degree, soft)};
  EXPECT_NEAR(inside[0].exponent, bonded_exponent_inside(all_around).real(), 1e-4);
}

// Each quarter with nodes of its own, as far as `tied` says with faces that are tied to those beside it.
Mesh loose_quarters(int count, const std::vector<char>& tied, std::mt19937& random) {
  const Mesh whole = quarters(count);
  Mesh mesh;
  mesh.bodies = whole.bodies;
  mesh.nodes.resize(4 * count, 2);
  for (int q = 0; q < count; ++q) {
    Cell cell = whole.cells[q];
    for (int a = 0; a < 4; ++a) {
      mesh.nodes.row(4 * q + a) = whole.nodes.row(cell.nodes[a]);
      cell.nodes[a] = 4 * q + a;
    }
    mesh.cells.push_back(cell);
    mesh.boundaries.push_back({"first" + std::to_string(q), {{2, {4 * q, 4 * q + 1, -1}}}});
    mesh.boundaries.push_back({"last" + std::to_string(q), {{2, {4 * q, 4 * q + 3, -1}}}});
  }
  for (int q = 0; q < count; ++q) {
    const int next = (q + 1) % count;
    if (!tied[q]) continue;
    std::array<int, 2> boundary{2 * q + 1, 2 * next}, body{q, next};
    if (random() % 2 == 0) std::swap(boundary[0], boundary[1]), std::swap(body[0], body[1]);
    mesh.ties.push_back({.key = "", .curves = {}, .boundary = boundary, .body = body, .nodes = {}});
  }
  return mesh;
}

// What is tied is one: the same as of parts that share nodes, at every node of the place.
TEST(BodyCorners, AcrossTiesAreThoseOfBondedParts) {
  std::mt19937 random(5);
  for (int k = 0; k < 60; ++k) {
    const int count = 2 + int(random() % 3);
    std::vector<ElasticLaw> laws;
    for (int q = 0; q < count; ++q)
      laws.push_back(elastic_law(random() % 2 == 0 ? 1 : 20, 0.3, {random() % 2 == 0 ? Plane::strain : Plane::stress}));
    std::vector<char> tied(count, 1);
    if (count < 4) tied.back() = 0;
    const Mesh loose = loose_quarters(count, tied, random);
    const SideTable table(loose);
    TipTable tips;
    const auto found = body_corners({loose, table, TiedVertices(loose, table), no_constraints(loose), laws, tips});
    const auto exact = corners_of(quarters(count), laws);
    std::size_t nodes = 0;
    for (const BodyCorner& corner : found) {
      const auto same = std::ranges::find_if(exact, [&](const auto& c) { return c.position == corner.position; });
      ASSERT_NE(same, exact.end()) << k;
      EXPECT_NEAR(corner.exponent, same->exponent, 1e-6) << k;
    }
    for (const BodyCorner& corner : exact)
      for (Eigen::Index i = 0; i < loose.nodes.rows(); ++i) nodes += loose.nodes.row(i).transpose() == corner.position;
    EXPECT_EQ(found.size(), nodes) << k;
  }
}

// The end of a tied curve within an edge of the other, which goes on.
TEST(BodyCorners, OfABlockTiedToALongerOneIsWhatBothMake) {
  std::mt19937 random(6);
  Mesh mesh = loose_quarters(4, {0, 0, 0, 1}, random);  // the fourth below the first
  for (const int node : {12, 13, 14, 15}) mesh.nodes(node, 0) = 3 * mesh.nodes(node, 0) - 1;
  const std::vector<ElasticLaw> laws(4, steel);
  const SideTable table(mesh);
  TipTable tips;
  const auto found = body_corners({mesh, table, TiedVertices(mesh, table), no_constraints(mesh), laws, tips});
  ASSERT_EQ(found.size(), 2u);
  for (const BodyCorner& corner : found) {
    EXPECT_EQ(corner.node, &corner - found.data());
    EXPECT_NEAR(corner.exponent, 0.5444837367, 1e-4);  // three quarters (Williams 1952)
  }
}

TEST(Williams, BondedWedgesOfOneMaterialAreOneWedge) {
  for (const double degrees : {200.0, 270.0, 350.0}) {
    const std::vector<Wedge> parts{wedge_of(70), wedge_of(degrees - 130), wedge_of(60)};
    for (const Face first : {Face::free, Face::clamped, Face::symmetric}) {
      Wedge whole = wedge_of(degrees);
      EXPECT_NEAR(std::abs(bonded_exponent(parts, first, Face::free) - wedge_exponent(whole, first)), 0, 1e-8);
    }
  }
}

TEST(Williams, ASoftBondedWedgeIsNoneAndAStiffOneASupport) {
  const std::vector<Wedge> soft{wedge_of(270), wedge_of(90, 1e-9)}, stiff{wedge_of(180), wedge_of(180, 1e9)};
  EXPECT_NEAR(bonded_exponent_inside(soft).real(), 0.5444837367, 1e-6);
  Wedge half = wedge_of(180);
  half.outer = Face::clamped;
  const std::vector<Wedge> joint{wedge_of(90), wedge_of(90, 1e9)};
  Wedge quarter = wedge_of(90);
  quarter.outer = Face::clamped;
  EXPECT_NEAR(std::abs(bonded_exponent(joint, Face::free, Face::free) - wedge_exponent(quarter, Face::free)), 0, 1e-6);
  EXPECT_NEAR(bonded_exponent_inside(stiff).real(), 1, 1e-3);  // a straight joint goes on
}

}  // namespace
}  // namespace mortise
