// A group of bodies as an operator, against dense algebra.
#include "ddm/body_group.hpp"

#include <gtest/gtest.h>

#include "base/dense.hpp"
#include "support/two_groups.hpp"

namespace mortise {
namespace {

using test::two_groups;
using test::TwoGroups;

MatX dimensionless_B(const TwoGroups& g) { return g.system.row_scale.cwiseInverse().asDiagonal() * MatX(g.system.B); }

TEST(BodyGroup, OfAHeldBodyIsItsComplianceAtTheRows) {
  const TwoGroups g = two_groups(false);
  const BodyGroup group(g.system, g.first);
  ASSERT_EQ(group.failed_at, -1);
  EXPECT_EQ(group.motions, 0);
  const MatX inverse = inverse_of(g.K().topLeftCorner(g.n, g.n)) * g.system.stiffness_scale;
  const MatX B = dimensionless_B(g).leftCols(g.n);
  const VecX f = g.system.f.head(g.n) / g.system.stiffness_scale;
  EXPECT_LE((group.C - B * inverse * B.transpose()).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LE(largest_entry(group.load.response - B * inverse * f), 1e-13);

  const VecX lambda = VecX::LinSpaced(g.m, -1, 2);
  VecX u = VecX::Zero(2 * g.n);
  group.add_displacements(group.load, lambda, VecX(), u);
  EXPECT_LE(largest_entry(u.head(g.n) - inverse * (f - B.transpose() * lambda)), 1e-13);
  EXPECT_EQ(largest_entry(u.tail(g.n)), 0);
  EXPECT_LE(largest_entry(B * u.head(g.n) - (group.load.response - group.C * lambda)), 1e-13);
  EXPECT_TRUE(group.has(3));
  EXPECT_FALSE(group.has(g.n + 3));
}

TEST(BodyGroup, OfAFloatingBodyNeedsALoadInBalance) {
  const TwoGroups g = two_groups(true);
  const BodyGroup group(g.system, g.second);
  ASSERT_EQ(group.failed_at, -1);
  ASSERT_EQ(group.motions, 1);
  const MatX B = dimensionless_B(g).rightCols(g.n);
  const VecX R = VecX::Ones(g.n), f = g.system.f.tail(g.n) / g.system.stiffness_scale;
  EXPECT_LE(largest_entry(group.H.col(0) - B * R), 1e-12);  // H = B R
  EXPECT_NEAR(group.load.work(0), f.sum(), 1e-12);          // R^T f

  VecX lambda = VecX::LinSpaced(g.m, -1, 2);  // in balance: H^T lambda = work
  lambda += group.H.col(0) * (group.load.work(0) - group.H.col(0).dot(lambda)) / group.H.col(0).squaredNorm();
  const VecX mu = VecX::Constant(1, 0.7);
  VecX u = VecX::Zero(2 * g.n);
  group.add_displacements(group.load, lambda, mu, u);
  const MatX K = g.K().bottomRightCorner(g.n, g.n) / g.system.stiffness_scale;
  EXPECT_LE(largest_entry(K * u.tail(g.n) - (f - B.transpose() * lambda)), 1e-12);
  EXPECT_LE(largest_entry(B * u.tail(g.n) - (group.load.response - group.C * lambda - group.H * mu)), 1e-12);
}

TEST(BodyGroup, ARefinementTakesUpTheForcesThatAreLeft) {
  const TwoGroups g = two_groups(false);
  const BodyGroup group(g.system, g.second);
  VecX u = VecX::Zero(2 * g.n);
  const VecX force = VecX::LinSpaced(2 * g.n, 1, 2);
  group.add_displacements(group.answer(force), VecX::Zero(g.m), VecX::Zero(group.motions), u);
  const MatX K = g.K().bottomRightCorner(g.n, g.n) / g.system.stiffness_scale;
  EXPECT_LE(largest_entry(K * u.tail(g.n) - force.tail(g.n)), 1e-12);
  EXPECT_EQ(largest_entry(u.head(g.n)), 0);
}

TEST(BodyGroup, NamesAnUnknownThatNothingHolds) {
  TwoGroups g = two_groups(false);
  const int last = 2 * g.n - 1;
  g.system.K.prune([&](int row, int column, double) { return row != last && column != last; });
  EXPECT_EQ(BodyGroup(g.system, g.second).failed_at, last);
}

}  // namespace
}  // namespace mortise
