// The local error of a pressure along its line.
#include "error/pressure_line.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace mortise {
namespace {

PressureLine line_of(const VecX& s, const std::function<double(double)>& p) {
  const Eigen::Index count = s.size();
  PressureLine line;
  line.s = s;
  line.p = s.unaryExpr(p);
  line.h = VecX::Zero(count);
  for (Eigen::Index i = 0; i + 1 < count; ++i) {
    line.h(i) += (s(i + 1) - s(i)) / 2;
    line.h(i + 1) += (s(i + 1) - s(i)) / 2;
  }
  line.h(0) *= 2;
  line.h(count - 1) *= 2;
  line.position.assign(count, Vec2::Zero());
  line.faced.assign(count - 1, 1);
  line.loaded.assign(count, 1);
  return line;
}

TEST(LineError, IsThatOfAPiecewiseLinearFunctionThroughASmoothOnesValues) {
  for (const int n : {10, 20, 40, 80}) {
    const auto p = [](double s) { return 2 + std::sin(3 * s); };
    const PressureLine line = line_of(VecX::LinSpaced(n + 1, 0, 1), p);
    const LineError found = line_error(line);
    double square = 0, worst = 0;
    for (int i = 0; i < n; ++i)
      for (int q = 0; q < 50; ++q) {
        const double t = (q + 0.5) / 50, s = (i + t) / n;
        const double error = p(s) - (1 - t) * line.p(i) - t * line.p(i + 1);
        square += error * error / (50.0 * n);
        worst = std::max(worst, std::abs(error));
      }
    EXPECT_NEAR(found.l2.norm() / std::sqrt(square), 1, n == 10 ? 0.1 : 0.05) << n;
    EXPECT_NEAR(found.pointwise(line).maxCoeff() / worst, 1, n == 10 ? 0.2 : 0.1) << n;
    EXPECT_EQ(std::ranges::count(found.border, 1), 0);
  }
}

TEST(LineError, OfALinearPressureIsZero) {
  VecX s(6);
  s << 0, 0.1, 0.3, 0.35, 0.7, 1;
  EXPECT_LE(line_error(line_of(s, [](double x) { return 1 + x; })).l2.maxCoeff(), 1e-14);
}

TEST(LineError, KnowsTheBorderOfContact) {
  const PressureLine line =
      line_of(VecX::LinSpaced(41, 0, 1), [](double s) { return std::sqrt(std::max(0.0, 0.51 - s)); });
  const LineError found = line_error(line);
  // p is 0 from vertex 21 on: the edge 20 holds the border, beside 20 edges in contact.
  ASSERT_EQ(found.borders.size(), 1u);
  EXPECT_EQ(found.borders[0].edge, 20);
  EXPECT_NEAR(found.borders[0].part, 1.0 / 20, 1e-12);
  for (int i = 0; i <= 40; ++i) EXPECT_EQ(found.border[i] != 0, i >= 19 && i <= 22) << i;
  EXPECT_NEAR(found.l2(20), 0.25 * line.p(19) / std::sqrt(2.0) * std::sqrt(line.h(20)), 1e-15);
  EXPECT_GT(line.p(19), std::sqrt(2.0) * line.p(20));  // else by the last
}

TEST(LineError, MeasuresBordersByHalfTheWidthOfTheirContact) {
  // Two contacts: of 10 edges inside the line, and of 6 up to its end.
  PressureLine line = line_of(VecX::LinSpaced(41, 0, 4), [](double s) {
    return s > 0.95 && s < 2.05 ? 1.0 : s > 3.35 ? 2.0 : 0.0;
  });
  const LineError found = line_error(line);
  ASSERT_EQ(found.borders.size(), 3u);
  EXPECT_NEAR(found.borders[0].part, 1.0 / 5, 1e-12);
  EXPECT_NEAR(found.borders[1].part, 1.0 / 5, 1e-12);
  EXPECT_NEAR(found.borders[2].part, 1.0 / 6, 1e-12);
}

TEST(LineError, GoesRoundAClosedCurve) {
  PressureLine line = line_of(VecX::LinSpaced(17, 0, 1), [](double s) {
    return 2 + std::cos(2 * std::numbers::pi * (s - 1.0 / 16));  // the largest jump at vertex 1
  });
  line.h.setConstant(1.0 / 16);
  line.closed = true;
  const LineError found = line_error(line);
  EXPECT_NEAR(found.l2(0), found.l2(16), 1e-15);
  EXPECT_NEAR(found.l2(0), found.l2(2), 1e-12);
  EXPECT_NEAR(found.pointwise(line)(15), found.l2(1) / std::sqrt(1.0 / 16) * std::sqrt(120.0) / 8, 1e-12);
  line.closed = false;
  EXPECT_LT(line_error(line).pointwise(line)(15), 0.99 * found.pointwise(line)(15));
}

// Wherever a closed curve begins: of borders, too, beside which p goes as a root.
TEST(LineError, AtVerticesOfAClosedCurveDoesNotHangOnItsSeam) {
  constexpr int n = 24;
  const auto at_seam = [&](int shift) {
    PressureLine line = line_of(VecX::LinSpaced(n + 1, 0, 3), [](double) { return 0; });
    for (int i = 0; i <= n; ++i)
      line.p(i) = std::sqrt(std::max(0.0, std::cos(2 * std::numbers::pi * (i + shift) / n) - 0.3));
    line.closed = true;
    line.h.setConstant(3.0 / n);
    return line_error(line).pointwise(line);
  };
  const VecX first = at_seam(0);
  for (int shift = 1; shift < n; ++shift) {
    const VecX turned = at_seam(shift);
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(turned(i), first((i + shift) % n), 1e-12 * largest_entry(first)) << shift << " " << i;
  }
}

// A line that goes on beyond what it faces: as one that ends there.
TEST(LineError, OfAnEndOfTheOtherSideIsThatOfAnEndOfTheLine) {
  const auto p = [](double s) { return 2 + std::sin(3 * s); };
  const LineError ends = line_error(line_of(VecX::LinSpaced(11, 0, 1), p));
  PressureLine line = line_of(VecX::LinSpaced(21, 0, 2), [&](double s) { return s < 1.01 ? p(s) : 0.0; });
  for (int e = 10; e < 20; ++e) line.faced[e] = 0;
  for (int i = 11; i <= 20; ++i) line.loaded[i] = 0;
  const LineError found = line_error(line);
  EXPECT_TRUE(found.borders.empty());
  EXPECT_EQ(std::ranges::count(found.border, 1), 0);
  EXPECT_LE((found.l2.head(11) - ends.l2).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ(found.l2.tail(10).maxCoeff(), 0);
  line.faced.assign(20, 1);  // open, not without another side
  EXPECT_EQ(line_error(line).borders.size(), 1U);
}

// Two edges face the other side, of the third a twentieth: its far vertex has a p of its neighbour's.
TEST(HardlyFaced, VerticesAreKnownNoBetterThanToTheirOwnSize) {
  const PressureLine line = line_of(VecX::LinSpaced(4, 0, 3), [](double) { return 7; });
  ContactPair pair{};
  for (const auto& [edge, length] : {std::pair(0, 1.0), {1, 0.4}, {1, 0.6}, {2, 0.05}}) {
    ContactPoint point{};
    point.edge = edge;
    point.ds = length;
    pair.points.push_back(point);
  }
  LineError error = line_error(line);
  add_hardly_faced(pair, line, error);
  ASSERT_EQ(error.least.size(), 4);
  EXPECT_EQ(error.least.head(3).maxCoeff(), 0);
  EXPECT_EQ(error.least(3), 7);
  pair.points.back().ds = 0.2;
  LineError well = line_error(line);
  add_hardly_faced(pair, line, well);
  EXPECT_FALSE(well.least.any());
}

}  // namespace
}  // namespace mortise
