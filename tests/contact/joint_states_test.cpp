// Exponents where joints open beside the point that they have in common.
#include "contact/joint_states.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/drawn_foot.hpp"

namespace mortise {
namespace {

using test::draw;
using test::draw_power;

Wedge of(double degrees, double young = 1) {
  return wedge(degrees * straight / 180, elastic_law(young, 0.3, {Plane::strain}));
}

constexpr Joint slides = Joint::sliding;

// One foot is pulled as much as the other is pressed, so it opens; which of the two, the loads decide.
TEST(JointStates, TheJointOfLikeBlocksOnAThirdIsThatBesideAFootThatOpens) {
  const Fan all{{of(180), of(90), of(90)}, {slides, slides, slides}};
  const Fan left_open{{of(180), of(90), of(90)}, {slides, slides}};
  EXPECT_EQ(exponents(all, 1).pressure, 1.0);
  const TipExponents joint = exponents_of_states(all, 1);
  EXPECT_NEAR(joint.pressure.real(), exponents(left_open, 1).pressure.real(), 1e-12);
  EXPECT_NEAR(joint.pressure.real(), 0.726586, 1e-6);
  EXPECT_EQ(joint.stress, exponents(all, 1).stress);  // all closed it is less
}

// Beyond a face of its own, so that what the foot parts is nothing to it: only the joint and the other foot are left.
TEST(JointStates, OfBodiesThatAreApartBesideAnOpenJointEachHasItsOwn) {
  const Fan all{{of(70, 3), of(120), of(80)}, {slides, slides}};
  ASSERT_LT(exponents(all, 1).stress.real(), 1);
  const TipExponents found = exponents_of_states(all, 1), alone = exponents({{of(120), of(80)}, {slides}}, 0);
  EXPECT_EQ(found.pressure.real(), std::min(exponents(all, 1).pressure.real(), alone.pressure.real()));
}

// Open beside the point it would be a crack, which closes where its tip presses.
TEST(JointStates, OnAStraightLineNothingOpens) {
  std::mt19937 random(3);
  int pulls = 0;
  for (int k = 0; k < 40; ++k) {
    const double angle = draw(random, 20, 160);
    const Wedge above = of(180, draw_power(random, -2, 2)), right = of(180 - angle, draw_power(random, -2, 2));
    const Fan fan{{above, of(angle), right}, {slides, Joint::bonded, slides}};
    EXPECT_EQ(exponents_of_states(fan, 0).pressure, exponents(fan, 0).pressure) << k;
    EXPECT_EQ(exponents_of_states(fan, 0).stress, exponents(fan, 0).stress) << k;
    const std::vector<TipMode> all = modes(fan);
    pulls += !all.empty() && all[0].pressure[0] * all[0].pressure[2] < 0;
  }
  EXPECT_GE(pulls, 5);
}

Fan drawn_fan(std::mt19937& random, int count, bool closed) {
  Fan fan{{}, std::vector<Joint>(count - (closed ? 0 : 1), slides)};
  double sum = 0;
  for (int i = 0; i < count; ++i)
    sum += fan.wedges.emplace_back(of(draw(random, 40, 120), draw_power(random, -1, 1))).angle;
  for (Wedge& w : fan.wedges) w.angle *= (closed ? 1 : draw(random, 0.6, 1)) * 2 * straight / sum;
  return fan;
}

TEST(JointStates, AreNeverLargerThanAllClosedAndTheSameInAMirror) {
  std::mt19937 random(21);
  for (int k = 0; k < 40; ++k) {
    const int count = 2 + k % 3;
    const Fan fan = drawn_fan(random, count, k % 2 == 0);
    Fan mirror = fan;
    std::ranges::reverse(mirror.wedges);
    for (int joint = 0; joint < int(fan.joints.size()); ++joint) {
      const TipExponents here = exponents_of_states(fan, joint), all_closed = exponents(fan, joint);
      const TipExponents there = exponents_of_states(mirror, (2 * count - 2 - joint) % count);
      EXPECT_LE(here.pressure.real(), all_closed.pressure.real());
      EXPECT_LE(here.stress.real(), all_closed.stress.real());
      if (fan.joints.size() == 1) EXPECT_EQ(here.pressure, all_closed.pressure);
      EXPECT_NEAR(here.pressure.real(), there.pressure.real(), 1e-7) << k << " " << joint;
    }
  }
}

// Modes that are not symmetric about a joint press nothing on it, and pull at one of two others.
TEST(JointStates, OfAJointOnALineOfSymmetryPIsUnboundedBesideOthersThatOpen) {
  std::mt19937 random(22);
  int smaller = 0;
  for (int k = 0; k < 30; ++k) {
    Fan fan = drawn_fan(random, 3, true);
    fan.wedges[2] = fan.wedges[1] = of(180 - 90 * fan.wedges[0].angle / straight, draw_power(random, -1, 1));
    const TipExponents found = exponents_of_states(fan, 1), all_closed = exponents(fan, 1);
    fan.joints.pop_back();
    const std::vector<TipMode> open = modes(fan);
    if (!(all_closed.stress.real() < all_closed.pressure.real()) || open.empty()) continue;
    const double least = std::min(all_closed.pressure.real(), open[0].exponent.real());
    if (open[0].pressure[0] * open[0].pressure[1] > 0)
      EXPECT_NEAR(found.pressure.real(), least, 1e-9) << k;
    else  // one of these is pulled too
      EXPECT_GT(found.pressure.real(), least + 1e-3) << k;
    smaller += found.pressure.real() < all_closed.pressure.real() - 1e-3;
  }
  EXPECT_GE(smaller, 5);
}

}  // namespace
}  // namespace mortise
