// Laws of layers between the sides of a pair: p of what these overlap, its slope and back.
#include "model/contact_law.hpp"

#include <gtest/gtest.h>

namespace mortise::test {
namespace {

const ContactLaw linear{.points = {{1, 3}}}, power{.points = {{2, 5}}, .exponent = 2.5},
    table{.points = {{1, 2}, {2, 8}, {4, 9}}};

TEST(ContactLaw, GoesThroughWhatIsGiven) {
  EXPECT_EQ(linear.pressure(2), 6);
  EXPECT_EQ(linear.slope(7), 3);
  EXPECT_EQ(power.pressure(2), 5);
  EXPECT_NEAR(power.pressure(8), 5 * 32, 1e-12);
  EXPECT_EQ(power.slope(0), 0);
  for (const Vec2& point : table.points) EXPECT_NEAR(table.pressure(point.x()), point.y(), 1e-14);
  EXPECT_NEAR(table.pressure(0.5), 1, 1e-14);
  EXPECT_NEAR(table.pressure(1.5), 5, 1e-14);
  EXPECT_NEAR(table.pressure(10), 12, 1e-14);  // as the last piece goes on
}

TEST(ContactLaw, IsOddAndGoesBack) {
  for (const ContactLaw& law : {linear, power, table})
    for (double d = 0; d < 8; d += 0.3) {
      EXPECT_EQ(law.pressure(-d), -law.pressure(d));
      EXPECT_NEAR(law.overlap(law.pressure(d)), d, 1e-13);
      EXPECT_NEAR(law.overlap(-law.pressure(d)), -d, 1e-13);
    }
}

TEST(ContactLaw, HasTheSlopeOfItsDifferences) {
  constexpr double h = 1e-6;
  for (const ContactLaw& law : {linear, power, table})
    for (double d = 0.05; d < 8; d += 0.3)
      EXPECT_NEAR(law.slope(d), (law.pressure(d + h) - law.pressure(d - h)) / (2 * h), 1e-7 * (1 + law.slope(d)));
}

}  // namespace
}  // namespace mortise::test
