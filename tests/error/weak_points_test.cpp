// Points at which p goes as a small power of the distance.
#include "error/weak_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/williams.hpp"

namespace mortise {
namespace {

constexpr double degree = std::numbers::pi / 180;

// p = s^d on even edges, at its end the value an edge further on.
PressureLine power(int edges, double d) {
  PressureLine line;
  line.s = VecX::LinSpaced(edges + 1, 0, 1);
  line.p = line.s.array().pow(d);
  line.p(0) = line.p(1);
  line.h = VecX::Constant(edges + 1, 1.0 / edges);
  for (const double s : line.s) line.position.emplace_back(s, 0.5);
  line.faced.assign(edges, 1);
  line.loaded.assign(edges + 1, 1);
  return line;
}

SingularPoint weak(double d) {
  SingularPoint point{
      .position = {0, 0.5}, .edge = 0.1, .exponent = 1, .pressure_exponent = 1, .meeting = Meeting::ends, .wedges = {}};
  point.small_power = d;
  return point;
}

// The end of a line at which the bodies' free faces stand 5 degrees from the normal: by perturbation of right angles p
// falls as r^(2.3 x 0.0873^2).
TEST(WeakPoints, AreEndsWhoseFacesAreNotAtRightAngles) {
  const auto wedge_of = [](double angle) { return Wedge{angle * degree, 1, 1.8}; };
  const TipExponents lean = end_exponents(wedge_of(95), wedge_of(85));
  EXPECT_EQ(lean.pressure, 1.0);
  EXPECT_NEAR(lean.falling - 1, 2.3 * std::pow(5 * degree, 2), 0.003);
  EXPECT_EQ(end_exponents(wedge_of(90), wedge_of(90)).falling, 1);
}

// int (r^d - its best hats)^2 on even edges, by Gauss points of pieces that halve towards the end: 0.4964 d and 0.3777
// d.
TEST(WeakPoints, MissInL2WhatHatsMissOfThePower) {
  for (const auto& [d, of_it] : {std::pair{0.0175, 0.4964}, {0.1, 0.3777}}) {
    const PressureLine line = power(30, d);
    LineError error{.l2 = VecX::Zero(31), .border = std::vector<char>(31, 0), .borders = {}};
    std::vector<SingularPoint> points{weak(d)};
    add_weak_points(line, points, error);
    EXPECT_NEAR(error.data.norm(), of_it * d * line.p(1) * std::sqrt(1.0 / 30), 0.02 * error.data.norm());
    EXPECT_EQ(error.data.tail(30).norm(), 0);
  }
}

TEST(WeakPoints, HaveBarsThatReachZeroAndLeaveTheList) {
  const PressureLine line = power(30, 0.1);
  LineError error{.l2 = VecX::Zero(31), .border = std::vector<char>(31, 0), .borders = {}};
  SingularPoint other = weak(0);
  other.exponent = other.pressure_exponent = 0.5;
  std::vector<SingularPoint> points{weak(0.1), other};
  add_weak_points(line, points, error);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].exponent, 0.5);
  ASSERT_EQ(error.least.size(), 31);
  EXPECT_NEAR(error.least(0), (1 - std::exp(-1.5)) * line.p(1), 1e-12);
  EXPECT_EQ(error.least(1), 0);
}

}  // namespace
}  // namespace mortise
