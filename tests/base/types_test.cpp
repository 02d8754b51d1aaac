// The sizes that every residual and every check is made of: NaN is never lost on the way.
#include "base/types.hpp"

#include <gtest/gtest.h>

namespace mortise {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Largest, KeepsNaNWhereverItStands) {
  EXPECT_EQ(largest(1, 2), 2);
  EXPECT_EQ(largest(2, 1), 2);
  EXPECT_TRUE(std::isnan(largest(not_a_number, 1)));
  EXPECT_TRUE(std::isnan(largest(1, not_a_number)));
  EXPECT_EQ(largest({-3, -1, -2}), -1);
  EXPECT_EQ(largest({1, infinity, 2}), infinity);
  EXPECT_TRUE(std::isnan(largest({not_a_number, 1, infinity})));
  EXPECT_TRUE(std::isnan(largest({1, not_a_number, infinity})));
  EXPECT_TRUE(std::isnan(largest({1, infinity, not_a_number})));
}

TEST(LargestEntry, KeepsNaNAndIsZeroOfNothing) {
  EXPECT_EQ(largest_entry(VecX()), 0);
  EXPECT_EQ(largest_entry(Eigen::Vector3d(1, -4, 2)), 4);
  EXPECT_TRUE(std::isnan(largest_entry(Eigen::Vector3d(1, not_a_number, 2))));
  EXPECT_TRUE(std::isnan(largest_entry(Eigen::Vector3d(not_a_number, 1, 2))));
}

TEST(Fraction, IsNotANumberWhereEitherIsNotFinite) {
  EXPECT_EQ(fraction(1, 2), 0.5);
  EXPECT_EQ(fraction(0, 0), 0);
  EXPECT_EQ(fraction(1, 0), infinity);
  for (const double bad : {not_a_number, infinity, -infinity}) {
    EXPECT_TRUE(std::isnan(fraction(bad, 1)));
    EXPECT_TRUE(std::isnan(fraction(1, bad)));
    EXPECT_TRUE(std::isnan(fraction(0, bad)));
    EXPECT_TRUE(std::isnan(fraction(bad, 0)));
  }
}

}  // namespace
}  // namespace mortise
