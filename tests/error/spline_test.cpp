// B-splines on knots of any distance.
#include "error/spline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace mortise {
namespace {

const std::vector<double> uneven_breaks{0, 0.1, 0.15, 0.5, 0.9, 1};

TEST(Splines, SumToOneFromEndToEnd) {
  for (const int degree : {1, 2, 3}) {
    const Knots knots = clamped_knots(degree, uneven_breaks);
    EXPECT_EQ(knots.count(), int(uneven_breaks.size()) - 1 + degree);
    for (const double s : {0.0, 0.05, 0.1, 0.3, 0.9, 0.99, 1.0}) {
      const SplineValues found = splines_at(knots, s);
      EXPECT_NEAR(std::accumulate(found.value.begin(), found.value.begin() + degree + 1, 0.0), 1, 1e-14);
      EXPECT_GE(found.first, 0);
      EXPECT_LT(found.first + degree, knots.count());
    }
  }
}

// With the means of the inner knots of each spline as coefficients the spline is s (Greville).
TEST(Splines, HaveStraightLines) {
  const Knots knots = clamped_knots(3, uneven_breaks);
  for (const double s : {0.0, 0.04, 0.12, 0.4, 0.77, 1.0}) {
    const SplineValues found = splines_at(knots, s);
    double sum = 0;
    for (int k = 0; k <= 3; ++k) {
      const auto* t = &knots.t[found.first + k];
      sum += found.value[k] * (t[1] + t[2] + t[3]) / 3;
    }
    EXPECT_NEAR(sum, s, 1e-14);
  }
}

TEST(Splines, OfOneIntervalAreBernsteinsPolynomials) {
  const SplineValues found = splines_at(clamped_knots(3, {0, 2}), 0.5);
  const double t = 0.25;
  EXPECT_EQ(found.first, 0);
  EXPECT_NEAR(found.value[1], 3 * t * (1 - t) * (1 - t), 1e-15);
  EXPECT_NEAR(found.value[3], t * t * t, 1e-15);
}

}  // namespace
}  // namespace mortise
