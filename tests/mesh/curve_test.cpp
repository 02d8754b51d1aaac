#include "mesh/curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "base/errors.hpp"
#include "grid.hpp"
#include "support/messages.hpp"

namespace mortise {
namespace {

using test::message_of;
using testing_meshes::all_kinds;
using testing_meshes::at;
using testing_meshes::contains;
using testing_meshes::Lattice;
using testing_meshes::make_cell;
using testing_meshes::plate;

std::string trouble(const Mesh& mesh, int boundary) {
  return message_of<InputError>([&] { contact_curve(mesh, boundary); });
}

/// The same edges in another order, half of them the other way round.
void shuffle(Boundary& boundary, unsigned seed) {
  std::mt19937 random(seed);
  std::shuffle(boundary.edges.begin(), boundary.edges.end(), random);
  for (Edge& edge : boundary.edges) {
    if (random() % 2 == 0) std::swap(edge.nodes[0], edge.nodes[1]);
  }
}

TEST(ContactCurve, RunsWithTheBodyOnItsLeft) {
  for (const CellKind kind : all_kinds()) {
    const Mesh mesh = plate(kind, 4, 3);
    for (int boundary = 0; boundary < 4; ++boundary) {
      const Curve curve = contact_curve(mesh, boundary);
      EXPECT_FALSE(curve.closed);
      EXPECT_EQ(curve.body, 0);
      EXPECT_EQ(curve.boundary, boundary);
      for (std::size_t i = 0; i < curve.edges.size(); ++i) {
        const Edge& edge = curve.edges[i];
        if (i > 0) {
          EXPECT_EQ(edge.nodes[0], curve.edges[i - 1].nodes[1]);
        }
        const Vec2 along = at(mesh, edge.nodes[1]) - at(mesh, edge.nodes[0]);
        const Vec2 middle = 0.5 * (at(mesh, edge.nodes[1]) + at(mesh, edge.nodes[0]));
        const Vec2 right = middle + 0.1 * Vec2(along.y(), -along.x());
        EXPECT_TRUE(right.x() < 0 || right.x() > 4 || right.y() < 0 || right.y() > 3) << right.transpose();
        EXPECT_EQ(side_edge(mesh.cells[curve.sides[i].cell], curve.sides[i].side).nodes, edge.nodes);
      }
    }
  }
}

TEST(ContactCurve, ComesOutTheSameWhateverTheOrderOfTheEdges) {
  for (const int boundary : {2, 4}) {  // open and closed
    Mesh mesh = plate(CellKind::quad8, 5, 2);
    const std::vector<int> nodes = curve_nodes(contact_curve(mesh, boundary));
    for (unsigned seed = 0; seed < 50; ++seed) {
      shuffle(mesh.boundaries[boundary], seed);
      EXPECT_EQ(curve_nodes(contact_curve(mesh, boundary)), nodes) << "seed " << seed;
    }
  }
}

TEST(ContactCurve, ClosesRoundABody) {
  for (const CellKind kind : all_kinds()) {
    const Mesh mesh = plate(kind, 3, 2);
    const Curve curve = contact_curve(mesh, 4);
    EXPECT_TRUE(curve.closed);
    EXPECT_EQ(curve.edges.size(), 10U);
    EXPECT_EQ(curve.edges.back().nodes[1], curve.edges.front().nodes[0]);
    EXPECT_EQ(at(mesh, curve.edges.front().nodes[0]), Vec2(0, 0));  // leftmost, then lowest
  }
}

TEST(ContactCurve, OfASingleEdge) {
  const Mesh mesh = plate(CellKind::tri3, 1, 1);
  const Curve curve = contact_curve(mesh, 0);
  EXPECT_EQ(curve.edges.size(), 1U);
  EXPECT_FALSE(curve.closed);
}

TEST(CurveNodes, HaveEachNodeOnce) {
  for (const CellKind kind : all_kinds()) {
    const Mesh mesh = plate(kind, 3, 2);
    const std::size_t per_edge = is_quadratic(kind) ? 2 : 1;
    const std::vector<int> open = curve_nodes(contact_curve(mesh, 0));
    const std::vector<int> closed = curve_nodes(contact_curve(mesh, 4));
    EXPECT_EQ(open.size(), 3 * per_edge + 1);
    EXPECT_EQ(closed.size(), 10 * per_edge);
    EXPECT_EQ(std::set<int>(closed.begin(), closed.end()).size(), closed.size());
    for (std::size_t i = 1; i < open.size(); ++i) EXPECT_LT(at(mesh, open[i - 1]).x(), at(mesh, open[i]).x());
  }
}

TEST(ContactCurve, SaysWhereItFallsIntoPieces) {
  Mesh mesh = plate(CellKind::quad8, 2, 2);
  Boundary& bottom = mesh.boundaries[0];
  const Boundary& top = mesh.boundaries[2];
  bottom.edges.insert(bottom.edges.end(), top.edges.begin(), top.edges.end());
  const std::string message = trouble(mesh, 0);
  EXPECT_TRUE(contains(message,
                       "plate.msh: boundary 'bottom' falls into pieces: one starts near (0, 0), another "
                       "near (2, 2)"))
      << message;
}

/// Two unit squares of one body, the second `shift` half units right and up of the first; "all" has their sides.
Mesh two_squares(int shift) {
  Lattice lattice;
  Mesh mesh;
  mesh.source = "squares.msh";
  mesh.bodies = {"one", "two"};
  for (const int s : {0, shift}) {
    mesh.cells.push_back(make_cell(lattice, CellKind::quad4, 0, {{s, s}, {s + 2, s}, {s + 2, s + 2}, {s, s + 2}}));
  }
  mesh.boundaries = {{"all", {}}};
  for (const Cell& cell : mesh.cells) {
    for (int side = 0; side < 4; ++side) mesh.boundaries[0].edges.push_back(side_edge(cell, side));
  }
  mesh.nodes = lattice.points();
  return mesh;
}

TEST(ContactCurve, SaysWhereItBranches) {
  const std::string message = trouble(two_squares(2), 0);
  EXPECT_TRUE(contains(message, "boundary 'all' branches near (1, 1)")) << message;
}

TEST(ContactCurve, OfTwoLoopsFallsIntoPieces) {
  const std::string message = trouble(two_squares(6), 0);
  EXPECT_TRUE(contains(message, "boundary 'all' falls into pieces: one starts near (0, 0), another near (3, 3)"))
      << message;
}

TEST(ContactCurve, BelongsToOneBody) {
  Mesh mesh = two_squares(6);
  mesh.cells[1].body = 1;
  const std::string message = trouble(mesh, 0);
  EXPECT_TRUE(contains(message, "belongs to more than one body: 'one', and 'two' near (3, 3)")) << message;
}

TEST(ContactCurve, HasEdgesOfItsBodyOnly) {
  Mesh mesh = plate(CellKind::quad8, 2, 2);
  mesh.boundaries[0].edges.push_back(side_edge(mesh.cells[0], 1));
  EXPECT_TRUE(contains(trouble(mesh, 0), "the edge near (1, 0.5) lies between two cells"));
  mesh.boundaries[0].edges.clear();
  EXPECT_TRUE(contains(trouble(mesh, 0), "boundary 'bottom' has no edges"));
}

}  // namespace
}  // namespace mortise
