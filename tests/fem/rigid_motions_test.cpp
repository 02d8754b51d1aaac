// Motions of whole bodies that nothing resists.
#include "fem/rigid_motions.hpp"

#include <gtest/gtest.h>

#include "support/two_plates.hpp"

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
  const auto motion = motion_through(mesh, motions, grounded, values);
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

}  // namespace
}  // namespace mortise
