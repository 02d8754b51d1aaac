// Singular points where more than two bodies meet: in contact, bonded, tied, or as the next sector of a ring has them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>

#include "contact/joint_states.hpp"
#include "contact/singular_points.hpp"
#include "support/drawn_foot.hpp"
#include "support/wedges.hpp"

namespace mortise {
namespace {

using test::draw;
using test::draw_power;
using test::end_exponents;

// The faces of each body lie on those of its neighbours, all around or from a free face to another; each pair knows
// its own two, as its first and second curve in either order, none at quite the same place.
TEST(PointsOfSeveralBodies, AreThoseOfAllThatAreInContact) {
  std::mt19937 random(8);
  TipTable tips;
  for (int k = 0; k < 40; ++k) {
    const int count = 3 + k % 3;
    const bool closed = k % 2 == 0;
    Fan fan{{}, std::vector<Joint>(count - (closed ? 0 : 1), Joint::sliding)};
    double sum = 0;
    for (int i = 0; i < count; ++i) {
      const double young = draw_power(random, -1, 1), angle = draw(random, 40, 120) * straight / 180;
      sum += fan.wedges.emplace_back(wedge(angle, elastic_law(young, 0.3, {Plane::strain}))).angle;
    }
    for (Wedge& w : fan.wedges) w.angle *= (closed ? 1 : draw(random, 0.6, 1)) * 2 * straight / sum;
    std::vector<std::vector<ContactPlace>> of_pairs;
    for (int i = 0; i < int(fan.joints.size()); ++i) {
      const int next = (i + 1) % count, first = int(random() % 2);
      ContactPlace place{.position = {1e-3 * draw(random, -1, 1), 1e-3 * draw(random, -1, 1)},
                         .bodies = {i, next},
                         .corners = {Corner{fan.wedges[i], true, 0.1}, Corner{fan.wedges[next], true, 0.1}},
                         .joined = {true, false},
                         .one_curve = false,
                         .given_slope = 0,
                         .shortest = 0.1};
      if (first == 1) {
        std::swap(place.bodies[0], place.bodies[1]);
        std::swap(place.corners[0], place.corners[1]);
        std::swap(place.joined[0], place.joined[1]);
      }
      of_pairs.push_back({place});
    }
    std::vector<std::vector<ContactPlace>> soft = of_pairs;
    soft[0][0].soft = true;
    const auto points = singular_points(of_pairs, tips), beside_soft = singular_points(soft, tips);
    for (std::size_t j = 0; j < fan.joints.size(); ++j) {
      const TipExponents exact = exponents_of_states(fan, j);
      const double of_all = exact.pressure.real() <= singular_limit ? exact.pressure.real() : 1;
      EXPECT_NEAR(points[j].empty() ? 1 : points[j][0].pressure_exponent, of_all, 1e-6) << k << " " << j;
    }
    const double of_two = end_exponents(fan.wedges[0], fan.wedges[1]).pressure.real();
    EXPECT_NEAR(beside_soft[0].empty() ? 1 : beside_soft[0][0].pressure_exponent, of_two <= singular_limit ? of_two : 1,
                1e-6);
  }
}

// Two parts of two materials, of one node or tied, both on another body that goes on.
TEST(PointsOfSeveralBodies, OfBondedPartsInContactWithOneBodyAreThoseOfAllThree) {
  std::mt19937 random(12);
  for (int k = 0; k < 20; ++k) {
    const auto of = [&](double angle) {
      return wedge(angle, elastic_law(draw_power(random, -1, 1), 0.3, {Plane::strain}));
    };
    const double angle = draw(random, 40, 140) * straight / 180;
    const Wedge left = of(straight - angle), right = of(angle), base = of(straight);
    ContactPlace of_left{.position = {0, 0},
                         .bodies = {0, 2},
                         .corners = {Corner{left, true, 0.1, 0, 7}, Corner{base, false, 0.1}},
                         .joined = {true, false},
                         .one_curve = false,
                         .given_slope = 0,
                         .shortest = 0.1},
        of_right = of_left;
    of_right.bodies = {1, 2};
    of_right.joined = {false, true};
    of_right.corners[0].wedge = right;
    of_right.corners[0].node = 7 + k % 2;
    of_left.corners[0].before = of_right.corners[0].after = Vec2(1, 0);
    of_left.corners[0].bonded = {{1, 7 + k % 2, right, 0}};
    of_right.corners[0].bonded = {{0, 7, left, 0}};
    TipTable tips;
    const auto points = singular_points({{of_left}, {of_right}}, tips);
    const Fan fan{{left, base, right}, {Joint::sliding, Joint::sliding, Joint::bonded}};
    for (const std::size_t pair : {0, 1}) {
      const double exact = exponents_of_states(fan, pair).pressure.real();
      EXPECT_NEAR(points[pair].empty() ? 1 : points[pair][0].pressure_exponent, exact > singular_limit ? 1 : exact,
                  1e-6);
    }
  }
}

// Two bodies that slide on one another up to a third one, of another material, on which both are tied.
TEST(PointsOfSeveralBodies, WhereContactEndsOnABodyThatBothAreTiedToAreThoseOfAllThree) {
  std::mt19937 random(14);
  for (int k = 0; k < 20; ++k) {
    const auto of = [&](double angle) {
      return wedge(angle, elastic_law(draw_power(random, -1, 1), 0.3, {Plane::strain}));
    };
    const double angle = draw(random, 40, 140) * straight / 180, turn = draw(random, -3, 3);
    const Wedge first = of(angle), last = of(straight - angle), base = of(straight);
    const Vec2 along(std::cos(turn), std::sin(turn));
    const ContactPlace place{.position = {0, 0},
                             .bodies = {2, 0},
                             .corners = {Corner{last, true, 0.1, 0, 8, -along, {}, {{0, 6, first, 0}, {1, 7, base, 0}}},
                                         Corner{first, true, 0.1, 0, 6, {}, along, {{1, 7, base, 0}, {2, 8, last, 0}}}},
                             .joined = {true, false},
                             .one_curve = false,
                             .given_slope = 0,
                             .shortest = 0.1};
    TipTable tips;
    const auto points = singular_points({{place}}, tips);
    const TipExponents exact = exponents({{first, base, last}, {Joint::bonded, Joint::bonded, Joint::sliding}}, 2);
    ASSERT_EQ(points[0].size(), 1u);
    EXPECT_NEAR(points[0][0].exponent, exact.stress.real(), 1e-6);
    EXPECT_NEAR(points[0][0].pressure_exponent, exact.pressure.real() > singular_limit ? 1 : exact.pressure.real(),
                1e-6);
  }
}

// A wheel and its tyre, cut to a sector along any line: at each cut stands what the next sector has at the other one.
TEST(PointsOfSeveralBodies, AtTheCutsOfASectorAreThoseOfAllAround) {
  std::mt19937 random(13);
  for (int k = 0; k < 40; ++k) {
    Fan fan{{}, {Joint::bonded, Joint::sliding, Joint::bonded, Joint::sliding}};
    double sum = 0;
    for (int i = 0; i < 4; ++i) {  // the wheel here and there, the tyre there and here
      const double stiffness =
          i % 2 == 1 && random() % 2 == 0 ? 2.6 / fan.wedges.back().compliance(2, 2) : draw_power(random, -1, 1);
      fan.wedges.push_back(wedge(draw(random, 1, 3), elastic_law(stiffness, 0.3, {Plane::strain})));
      sum += fan.wedges.back().angle;
    }
    for (Wedge& w : fan.wedges) w.angle *= 2 * straight / sum;
    const auto& [wheel, next_wheel, next_tyre, tyre] =
        std::tie(fan.wedges[0], fan.wedges[1], fan.wedges[2], fan.wedges[3]);
    const double turn = draw(random, -2, 2), end = wheel.angle + next_wheel.angle - turn;
    const auto along = [](double a) { return Vec2(std::cos(a), std::sin(a)); };
    const auto off = [](Wedge w) {  // as its mesh has it, not the drawn curve
      w.angle += 0.01;
      return w;
    };
    ContactPlace here{.position = {1, 2},
                      .bodies = {2, 0},
                      .corners = {Corner{tyre, true, 0.1, 0, 3, -along(0), {}, {{3, 4, off(next_tyre), turn}}},
                                  Corner{wheel, true, 0.1, 0, 1, {}, along(0), {{1, 2, off(next_wheel), turn}}}},
                      .joined = {true, false},
                      .one_curve = false,
                      .given_slope = 0,
                      .shortest = 0.1},
        there = here;
    there.position = {-2, 1};
    there.bodies = {1, 3};
    there.corners = {Corner{next_wheel, true, 0.1, 0, 2, -along(end), {}, {{0, 1, off(wheel), -turn}}},
                     Corner{next_tyre, true, 0.1, 0, 4, {}, along(end), {{2, 3, off(tyre), -turn}}}};
    TipTable tips;
    const auto points = singular_points({{here}, {there}}, tips);
    for (const std::size_t pair : {0, 1}) {
      const double exact = exponents_of_states(fan, pair == 0 ? 3 : 1).pressure.real();
      EXPECT_NEAR(points[pair].empty() ? 1 : points[pair][0].pressure_exponent, exact > singular_limit ? 1 : exact,
                  1e-6)
          << k;
    }
  }
}

}  // namespace
}  // namespace mortise
