// Motions of whole bodies that nothing resists.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "fem/elements.hpp"
#include "fem/motion_sets.hpp"
#include "support/two_plates.hpp"
#include "support/wall.hpp"

namespace mortise {
namespace {

TEST(FreeMotions, AreCountedAndNamed) {
  const Mesh mesh = test::mesh_of({});
  const SparseMatrix none(0, 2 * mesh.nodes.rows());
  Constraints c = no_constraints(mesh);
  EXPECT_EQ(free_motions(mesh, c, none).size(), 6u);
  prescribe(mesh, boundary_index(mesh, "bottom"), 0, 0, c);
  prescribe(mesh, boundary_index(mesh, "bottom"), 1, 0, c);
  EXPECT_EQ(free_motions(mesh, c, none).size(), 3u);
  prescribe(mesh, boundary_index(mesh, "upper_left"), 0, 0, c);
  const auto motions = free_motions(mesh, c, none);
  ASSERT_EQ(motions.size(), 1u);
  EXPECT_NE(describe(mesh, motions[0]).find("body 'upper': translation (0, "), std::string::npos)
      << describe(mesh, motions[0]);
  const auto grounded = grounding_unknowns(mesh, c, motions);
  ASSERT_EQ(grounded.size(), 1u);
  EXPECT_EQ(grounded[0] % 2, 1);  // vertical
}

TEST(FreeMotions, AreFoundFromWhatTheGroundedUnknownsDo) {
  const Mesh mesh = test::mesh_of({});
  Constraints c = no_constraints(mesh);
  prescribe(mesh, boundary_index(mesh, "bottom"), 0, 0, c);
  prescribe(mesh, boundary_index(mesh, "bottom"), 1, 0, c);
  prescribe(mesh, boundary_index(mesh, "top"), 0, 0, c);
  const auto motions = free_motions(mesh, c, SparseMatrix(0, 2 * mesh.nodes.rows()));
  const auto grounded = grounding_unknowns(mesh, c, motions);
  ASSERT_EQ(grounded.size(), 2u);  // up and down, and about the top's nodes, which all move sideways alike
  // A turn by 0.1 about (0.4, 0.6): what the grounded unknowns do in it gives it back, over its largest translation.
  VecX values(2);
  for (Eigen::Index k = 0; k < 2; ++k) {
    const Vec2 arm = mesh.nodes.row(grounded[k] / 2).transpose() - Vec2(0.4, 0.6);
    values(k) = 0.1 * (grounded[k] % 2 ? arm.x() : -arm.y());
  }
  MatX both(2, 2);
  both << -values, values;
  const auto through = motions_through(mesh, motions, grounded, both);
  ASSERT_EQ(through.size(), 2u);
  EXPECT_NEAR(through[0][0].rotation, -1 / 0.15, 1e-8);
  const auto& motion = through[1];
  ASSERT_EQ(motion.size(), 1u);
  EXPECT_EQ(motion[0].body, 0);
  EXPECT_NEAR(motion[0].centre.y(), 0.45, 1e-12);
  EXPECT_NEAR(motion[0].translation.x(), 1, 1e-10);  // the body's centre lies 0.15 below the pivot
  EXPECT_NEAR(motion[0].translation.y(), 0, 1e-10);
  EXPECT_NEAR(motion[0].rotation, 1 / 0.15, 1e-8);
}

// Contact of a body's rim with its surroundings, which do not move: normals at `count` unevenly spaced places.
std::vector<ContactNormal> rim(int count, double eccentricity) {
  std::vector<ContactNormal> normals;
  for (int k = 0; k < count; ++k) {
    const double angle = k + 0.3 * std::sin(3.0 * k), c = std::cos(angle), s = std::sin(angle);
    normals.push_back(
        {{0.4 + 0.2 * c, 0.45 + (1 + eccentricity) * 0.2 * s}, Vec2((1 + eccentricity) * c, s).normalized(), 0, 1});
  }
  return normals;
}

TEST(FreeMotions, ARoundRimTurnsAnOvalOneDoesNot) {
  const Mesh mesh = test::mesh_of({});
  Constraints c = no_constraints(mesh);
  for (const int component : {0, 1}) prescribe(mesh, boundary_index(mesh, "bottom"), component, 0, c);
  const auto motions = free_motions(mesh, c, rim(20, 0));
  ASSERT_EQ(motions.size(), 1U);
  ASSERT_EQ(motions[0].size(), 1U);
  EXPECT_LE(motions[0][0].translation.norm(), 1e-12 * std::abs(motions[0][0].rotation));  // about the rim's centre
  EXPECT_TRUE(free_motions(mesh, c, rim(20, 1e-3)).empty());
  EXPECT_EQ(free_motions(mesh, c, rim(20, 1e-8)).size(), 1U);
}

TEST(FreeMotions, ComeApartBodyByBody) {
  const Mesh mesh = test::mesh_of({});
  const auto motions = free_motions(mesh, no_constraints(mesh), SparseMatrix(0, 2 * mesh.nodes.rows()));
  ASSERT_EQ(motions.size(), 6U);
  for (const auto& motion : motions) {
    ASSERT_EQ(motion.size(), 1U);
    const RigidMotion& m = motion[0];  // one translation or the rotation, alone
    EXPECT_EQ(
        (std::abs(m.translation.x()) > 1e-10) + (std::abs(m.translation.y()) > 1e-10) + (std::abs(m.rotation) > 1e-10),
        1);
  }
}

// Nothing is kept of size bodies x unknowns: each block's motions are told at its own nodes.
TEST(FreeMotions, OfManyBodiesAreHeldByTheirOwnNodes) {
  const int n = 6;
  const Mesh mesh = test::wall(n, 1).mesh;
  const Constraints c = no_constraints(mesh);
  const auto motions = free_motions(mesh, c, SparseMatrix(0, 2 * mesh.nodes.rows()));
  ASSERT_EQ(motions.size(), std::size_t(3 * n * n));
  Eigen::Index entries = 0;
  for (const MotionSet& set : motion_sets(mesh, motions)) {
    EXPECT_EQ(set.motions.size(), 3U);
    entries += set.fields.size();
    EXPECT_GT(std::abs(motions_at(set, grounding_unknowns(mesh, c, motions)).determinant()), 0.1);
  }
  EXPECT_EQ(entries, 3 * 2 * mesh.nodes.rows());
}

// Bodies that a motion joins, one of which moves in two: what least_motions adds leaves u orthogonal to each motion
// over the bodies' areas, here by midpoints of cells that are cut into many.
TEST(FreeMotions, OfLeastMeanSquareLeaveNothingAlongThemselves) {
  const Mesh mesh = test::wall(2, 1).mesh;
  const auto single = free_motions(mesh, no_constraints(mesh), SparseMatrix(0, 2 * mesh.nodes.rows()));
  ASSERT_EQ(single.size(), 12U);
  const auto joined = [&](std::size_t i, std::size_t j) {
    auto both = single[i];
    both.insert(both.end(), single[j].begin(), single[j].end());
    return both;
  };
  const std::vector<std::vector<RigidMotion>> motions = {joined(0, 4), joined(5, 6), single[2], single[9]};
  VecX u(2 * mesh.nodes.rows());
  for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) {
    const Vec2 x = mesh.nodes.row(i);
    u.segment<2>(2 * i) << 1 + x.x() * x.y(), x.x() - 2 * x.y();
  }
  const auto least = least_motions(mesh, motions, u);
  ASSERT_EQ(least.size(), 2U);  // the last is a set of its own
  const auto field = [&](const std::vector<RigidMotion>& motion, const Cell& cell, const Vec2& x) -> Vec2 {
    Vec2 sum = Vec2::Zero();
    for (const RigidMotion& of_body : motion)
      if (of_body.body == cell.body) sum += of_body.at(x);
    return sum;
  };
  VecX left = VecX::Zero(4), before = VecX::Zero(4);
  const int n = 40;
  for (const Cell& cell : mesh.cells)
    for (int i = 0; i < n * n; ++i) {
      const Vec2 xi(-1 + (2 * (i % n) + 1.0) / n, -1 + (2 * (i / n) + 1.0) / n);
      const CellShape shape = cell_shape(cell.kind, xi);
      Vec2 x = Vec2::Zero(), value = Vec2::Zero();
      for (int a = 0; a < node_count(cell.kind); ++a) {
        x += shape.N[a] * mesh.nodes.row(cell.nodes[a]).transpose();
        value += shape.N[a] * u.segment<2>(2 * cell.nodes[a]);
      }
      const double area = 4.0 / (n * n) * cell_point(mesh.nodes, cell, shape).jacobian();
      for (int m = 0; m < 4; ++m) {
        before(m) += area * field(motions[m], cell, x).dot(value);
        left(m) += area * field(motions[m], cell, x).dot(value + field(least[0], cell, x) + field(least[1], cell, x));
      }
    }
  EXPECT_GT(before.cwiseAbs().minCoeff(), 1e-3);
  EXPECT_LT(left.cwiseAbs().maxCoeff(), 1e-3 * before.cwiseAbs().maxCoeff());  // the midpoints' own error
}

// Blocks in rows, held where they stand: what moves is each row along itself, with all its blocks, and its blocks alone
// if the joints between them are left out. 40 bodies: more than are looked at all at once.
TEST(FreeMotions, OfManyBodiesInContactAreFoundTogether) {
  const int n = 40;
  std::vector<test::Patch> blocks;
  for (int i = 0; i < n; ++i) {
    blocks.push_back(test::block(
        std::string("b") + std::to_string(i), 2, 2, i, i + 1, [](double) { return 0; }, [](double) { return 1; }));
  }
  const Mesh mesh = test::mesh_of(blocks, CellKind::quad4);
  Constraints c = no_constraints(mesh);
  for (int i = 0; i < n; ++i)
    prescribe(mesh, boundary_index(mesh, std::string("b") + std::to_string(i) + "_south"), 1, 0, c);
  std::vector<ContactNormal> joints;
  for (int i = 0; i + 1 < n; ++i)
    for (const double y : {0., 0.5, 1.}) joints.push_back({{i + 1., y}, {1, 0}, i, i + 1});
  const auto together = free_motions(mesh, c, joints);
  ASSERT_EQ(together.size(), 1U);
  ASSERT_EQ(together[0].size(), std::size_t(n));
  for (const RigidMotion& m : together[0]) {
    EXPECT_NEAR(std::abs(m.translation.x()), 1, 1e-6);
    EXPECT_NEAR(m.translation.y(), 0, 1e-6);
    EXPECT_NEAR(m.rotation, 0, 1e-6);
  }
  EXPECT_EQ(free_motions(mesh, c, std::vector<ContactNormal>{}).size(), std::size_t(n));
  prescribe(mesh, boundary_index(mesh, "b7_south"), 0, 0, c);
  EXPECT_TRUE(free_motions(mesh, c, joints).empty());
}

TEST(RigidMotions, AreDescribedByTheirDirectionOrTheirCentre) {
  Mesh mesh;
  mesh.bodies = {"pin", "block"};
  mesh.nodes = Points{{0, 0}, {30, 40}};
  const auto said = [&](std::vector<RigidMotion> motion) { return describe(mesh, motion); };
  const Vec2 none(0, 0), centre(3, 4);
  EXPECT_EQ(said({{0, Vec2(1, 1e-9), 0, centre}}), "body 'pin': translation (1, 0)");
  EXPECT_EQ(said({{0, none, 0.2, centre}}), "body 'pin': rotation about (3, 4)");
  // At (7, 4) a turn by -0.2 moves up by -0.2 * (7 - 3) = -0.8, which the translation takes back.
  EXPECT_EQ(said({{1, Vec2(0, 0.8), -0.2, centre}}), "body 'block': clockwise rotation about (7, 4)");
  EXPECT_EQ(said({{0, Vec2(0, 1), 1e-9, centre}, {1, none, 1e-12, centre}}), "body 'pin': translation (0, 1)");
  EXPECT_EQ(said({{0, Vec2(1, 0), 0, centre}, {1, none, 1, centre}}),
            "body 'pin': translation (1, 0); body 'block': rotation about (3, 4)");
}

}  // namespace
}  // namespace mortise
