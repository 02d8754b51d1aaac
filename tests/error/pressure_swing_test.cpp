// How far p swings from node to node.
#include "error/pressure_swing.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace mortise {
namespace {

PressureNodes nodes_at(const VecX& s, const VecX& p) {
  return {.step = 1, .s = s, .p = p, .smooth = std::vector<char>(s.size(), 1)};
}

VecX even(int edges) { return VecX::LinSpaced(edges + 1, 0, 1); }

VecX zigzag(int nodes, double height) {
  return VecX::NullaryExpr(nodes, [&](Eigen::Index i) { return i % 2 == 0 ? height : -height; });
}

TEST(Swings, OfACubicAreNone) {
  VecX s(12);
  s << 0, 0.05, 0.2, 0.25, 0.31, 0.4, 0.55, 0.6, 0.72, 0.8, 0.95, 1;
  const VecX p = 1 + s.array() - 3 * s.array().square() + 2 * s.array().cube();
  EXPECT_LE(swings(nodes_at(s, p)).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Swings, AboutASmoothPressureAreSeenInFullUpToTheEnds) {
  const VecX s = even(20), p = (3 * s).array().sin();
  const VecX found = means_at_vertices(nodes_at(s, p), swings(nodes_at(s, p + zigzag(21, 1e-2))));
  EXPECT_GE(found.minCoeff(), 0.9e-2);
  EXPECT_LE(found.maxCoeff(), 1.6e-2);
}

TEST(Swings, OfASmoothPressureFallWithTheFourthPowerOfTheEdges) {
  double before = 1;
  for (const int edges : {20, 40, 80}) {
    const VecX s = even(edges);
    const double worst = swings(nodes_at(s, (3 * s).array().sin())).cwiseAbs().maxCoeff();
    EXPECT_LT(worst, before / 10);
    before = worst;
  }
}

TEST(Swings, DoNotLookAcrossWhatIsLeftOut) {
  const VecX s = even(20);
  VecX p = (s.array() > 0.5).select(VecX(1 + s.array()), VecX(2 * s));
  PressureNodes nodes = nodes_at(s, p);
  EXPECT_GT(swings(nodes).cwiseAbs().maxCoeff(), 0.1);
  nodes.smooth[10] = 0;  // where it jumps
  EXPECT_LE(swings(nodes).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Swings, AreNotSaidOfFewerNodesThanACubicNeeds) {
  EXPECT_EQ(swings(nodes_at(even(3), zigzag(4, 1))).cwiseAbs().maxCoeff(), 0);
  EXPECT_GT(swings(nodes_at(even(4), zigzag(5, 1))).cwiseAbs().minCoeff(), 0.1);
}

TEST(Swings, MeansLeaveOutWhatIsNotKnown) {
  PressureNodes nodes = nodes_at(even(2), VecX::Ones(3));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_DOUBLE_EQ(means_at_vertices(nodes, Eigen::Vector3d(nan, 3, -3))(0), 3);
  EXPECT_EQ(means_at_vertices(nodes, VecX::Constant(3, nan))(1), std::numeric_limits<double>::infinity());
}

// Vertices 0, 1, 2 and the middles between them.
TEST(Swings, TakeTheMiddlesOfEdgesThatHaveMultipliers) {
  PressureLine line;
  line.s = Eigen::Vector3d(0, 1, 3);
  line.p = Eigen::Vector3d(4, 5, 6);
  line.middle = Eigen::Vector2d(7, 8);
  line.h = Eigen::Vector3d(1, 1.5, 2);
  line.faced = {1, 1};
  line.loaded = {1, 1, 1};
  const PressureNodes nodes = pressure_nodes(line, {0, 0, 1});
  EXPECT_EQ(nodes.step, 2);
  EXPECT_EQ(nodes.s, (VecX(5) << 0, 0.5, 1, 2, 3).finished());
  EXPECT_EQ(nodes.p, (VecX(5) << 4, 7, 5, 8, 6).finished());
  EXPECT_EQ(nodes.smooth, (std::vector<char>{1, 1, 1, 0, 0}));
}

TEST(Swings, RaiseTheLocalErrorOnlyWhereTheyAreMore) {
  PressureLine line;
  line.h = Eigen::Vector3d(4, 4, 4);
  line.loaded = {1, 1, 0};
  LineError local(3);
  local.l2 = Eigen::Vector3d(1, 3, 0);
  set_swing(Eigen::Vector3d(1, 1, 1), line, local);
  EXPECT_EQ(local.whole(), Eigen::Vector3d(2, 3, 0));
}

}  // namespace
}  // namespace mortise
