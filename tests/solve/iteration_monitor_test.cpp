// When an iteration stops, and what its record says.
#include "solve/iteration_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mortise {
namespace {

constexpr Residuals large{1, 1};

TEST(IterationMonitor, ConvergesOnBothResiduals) {
  IterationMonitor monitor(1e-3, 100);
  EXPECT_TRUE(monitor.go_on({1e-4, 1}, 1));
  EXPECT_TRUE(monitor.go_on({1, 1e-4}, 1));
  EXPECT_FALSE(monitor.go_on({1e-4, 1e-3}, 1));
  EXPECT_EQ(monitor.status(), SolveStatus::converged);
  EXPECT_EQ(monitor.steps(), 2);
  EXPECT_EQ(monitor.history().size(), 3U);
}

TEST(IterationMonitor, DivergesOnGrowthAndOnWhatIsNotFinite) {
  for (const double grown : {1.1e6, std::nan(""), HUGE_VAL}) {
    IterationMonitor monitor(1e-3, 100);
    EXPECT_TRUE(monitor.go_on(large, 3));
    EXPECT_TRUE(monitor.go_on(large, 1));
    EXPECT_FALSE(monitor.go_on(large, grown));
    EXPECT_EQ(monitor.status(), SolveStatus::diverged) << grown;
  }
}

TEST(IterationMonitor, StopsAfterItsSteps) {
  IterationMonitor monitor(1e-3, 2);
  EXPECT_TRUE(monitor.go_on(large, 1));
  EXPECT_TRUE(monitor.go_on(large, 1));
  EXPECT_FALSE(monitor.go_on(large, 1));
  EXPECT_EQ(monitor.status(), SolveStatus::not_converged);
  EXPECT_TRUE(monitor.exhausted());
}

TEST(IterationMonitor, TheRateIsTheGeometricMeanOfTheLastHalf) {
  IterationMonitor monitor(0, 100);
  for (const double size : {100.0, 10.0, 8.0, 4.0, 2.0}) monitor.go_on(large, size);
  EXPECT_NEAR(monitor.convergence_rate(), 0.5, 1e-15);  // 8 -> 2 in two steps
}

TEST(IterationMonitor, TheRateOfNothingIsZero) {  // contact that opens everywhere, down to underflow
  EXPECT_EQ(IterationMonitor(0, 100).convergence_rate(), 0);
  IterationMonitor monitor(0, 100);
  for (const double size : {1.0, 0.0, 0.0, 0.0, 0.0}) monitor.go_on(large, size);
  EXPECT_EQ(monitor.convergence_rate(), 0);
}

}  // namespace
}  // namespace mortise
