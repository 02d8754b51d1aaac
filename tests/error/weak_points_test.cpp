// Points at which p goes as a small power of the distance.
#include "error/weak_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/wedges.hpp"

namespace mortise {
namespace {

using test::end_exponents;

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
  const auto wedge_of = [](double angle) { return wedge(angle * degree, elastic_law(1, 0.3, {Plane::strain})); };
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
    LineError error(31);
    std::vector<SingularPoint> points{weak(d)};
    add_weak_points(line, points, error);
    EXPECT_NEAR(error.data.norm(), of_it * d * line.p(1) * std::sqrt(1.0 / 30), 0.02 * error.data.norm());
    EXPECT_EQ(error.data.tail(30).norm(), 0);
  }
}

TEST(WeakPoints, HaveBarsThatReachZeroAndLeaveTheList) {
  const PressureLine line = power(30, 0.1);
  LineError error(31);
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

// int (ln |s - s_i| - its best hats)^2 on even edges, by Gauss points of pieces that halve towards s_i.
TEST(WeakPoints, MissOfALogarithmWhatHatsMissOfIt) {
  const int edges = 30, at = 15;
  const double h = 1.0 / edges;
  const PressureLine line = power(edges, 0);
  // By s of each edge: Gauss points of pieces that halve towards an end that is s_i.
  std::vector<std::pair<double, double>> points;  // s, weight
  const auto add = [&](double from, double to) {
    for (const double g : {-std::sqrt(0.6), 0.0, std::sqrt(0.6)})
      points.emplace_back((from + to) / 2 + (to - from) / 2 * g, (to - from) / 18 * (g == 0 ? 8 : 5));
  };
  for (int e = 0; e < edges; ++e)
    for (int k = 0; k < 60; ++k) {
      const double large = h * std::pow(0.5, k), small = k == 59 ? 0 : large / 2;
      if (e + 1 == at)
        add((e + 1) * h - large, (e + 1) * h - small);
      else if (e == at)
        add(e * h + small, e * h + large);
      else if (k < 20)
        add(e * h + k * h / 20, e * h + (k + 1) * h / 20);
    }
  MatX mass = MatX::Zero(edges + 1, edges + 1);
  VecX right = VecX::Zero(edges + 1);
  double square = 0;
  for (const auto& [s, weight] : points) {
    const int e = std::clamp(int(s / h), 0, edges - 1);
    const double part = s / h - e, value = std::log(std::max(std::abs(s - at * h), 1e-300));
    const Vec2 hats(1 - part, part);
    mass.block<2, 2>(e, e) += weight * hats * hats.transpose();
    right.segment<2>(e) += weight * value * hats;
    square += weight * value * value;
  }
  const double missed = std::sqrt(square - right.dot(mass.ldlt().solve(right)));
  LineError error(edges + 1);
  add_weak_logarithm(line, line.position[at], 3, error);
  ASSERT_EQ(error.data.size(), edges + 1);
  EXPECT_NEAR(error.data.norm(), 3 * missed, 0.03 * error.data.norm());
  EXPECT_EQ(error.data(at), error.data.norm());
}

// At an end that gives way, on edges far shorter than E* / k, what hats miss of (|d| p k / E*) r ln r: 0.1095 c h^1.5
// in L2, 0.3606 c h at the end (solved for on 60 even edges); on edges far longer, as at closed contact, from there
// down to E* / k.
TEST(WeakPoints, OfContactThatGivesWayAreRoundedOffByTheLayer) {
  const int edges = 30;
  const double h = 1.0 / edges, modulus = 500, d = 0.1;
  const PressureLine line = power(edges, d);
  const double p = line.p(0);
  const auto at_end = [&](double power, double stiffness) {
    LineError error(edges + 1);
    add_layer_ends(line, {weak(power)}, {.points = {Vec2(1, stiffness)}}, modulus, error);
    EXPECT_EQ(error.data.tail(edges).norm() + error.least.tail(edges).norm(), 0);
    return Vec2(error.data(0), error.least(0));
  };
  const double soft = 1e-3 * modulus / h;
  EXPECT_NEAR(at_end(d, soft)(0), 0.1095 * d * p * soft / modulus * std::pow(h, 1.5), 0.01 * at_end(d, soft)(0));
  EXPECT_NEAR(at_end(-d, soft)(1), 0.3606 * d * p * soft / modulus * h, 0.01 * at_end(-d, soft)(1));
  LineError closed(edges + 1);
  std::vector<SingularPoint> points{weak(d)};
  add_weak_points(line, points, closed);
  const double hard = 1e5 * modulus / h;
  EXPECT_NEAR(at_end(d, hard)(0), closed.data(0), 1e-3 * closed.data(0));
  EXPECT_NEAR(at_end(d, hard)(1), p * (1 - std::pow(0.36e5, -d)), 1e-3 * p);
  EXPECT_NEAR(at_end(-d, hard)(1), p * (std::pow(0.36e5, d) - 1), 1e-3 * p);
  SingularPoint rollers = weak(-d);
  for (Wedge& wedge : rollers.wedges) wedge.outer = Face::symmetric;
  LineError between(edges + 1);
  add_layer_ends(line, {rollers}, {.points = {Vec2(1, soft)}}, modulus, between);
  EXPECT_NEAR(between.data(0), d * at_end(-d, soft)(0), 1e-9 * between.data(0));
  EXPECT_NEAR(between.least(0), d * at_end(-d, soft)(1), 1e-9 * between.least(0));
}

// A row that opens at the end of contact that gives way: p is 0 there and begins at the next vertex.
TEST(WeakPoints, AnEndWithoutPressureMissesNothing) {
  const int edges = 30;
  PressureLine line = power(edges, 0.1);
  line.p(0) = 0;
  LineError error(edges + 1);
  add_layer_ends(line, {weak(0.1)}, {.points = {Vec2(1, 20)}}, 500, error);
  EXPECT_EQ(error.data.norm() + error.least.norm(), 0);
}

// p = -A ln r where the slope of a given gap ends on a line of symmetry: the limit of d p = A.
TEST(WeakPoints, OfContactThatGivesWayMayBeLogarithms) {
  const int edges = 30;
  const double h = 1.0 / edges, modulus = 500, amplitude = 3;
  const PressureLine line = power(edges, 0);
  SingularPoint end = weak(0);
  end.log_pressure = amplitude;
  const auto at_end = [&](double stiffness) {
    LineError error(edges + 1);
    add_layer_ends(line, {end}, {.points = {Vec2(1, stiffness)}}, modulus, error);
    return Vec2(error.data(0), error.least(0));
  };
  const double soft = 1e-3 * modulus / h, hard = 1e5 * modulus / h;
  EXPECT_NEAR(at_end(soft)(0), 0.1095 * amplitude * soft / modulus * std::pow(h, 1.5), 0.01 * at_end(soft)(0));
  EXPECT_NEAR(at_end(soft)(1), 0.3606 * amplitude * soft / modulus * h, 0.01 * at_end(soft)(1));
  EXPECT_NEAR(at_end(hard)(1), amplitude * std::log(0.36e5), 1e-3 * at_end(hard)(1));
}

}  // namespace
}  // namespace mortise
