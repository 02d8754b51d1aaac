#include "base/interval.hpp"

#include <gtest/gtest.h>

namespace mortise {
namespace {

// An infinite end stands for numbers as large as may be: 0 of them is 0.
TEST(Interval, NothingTimesWhatHasNoEndIsNothing) {
  const Interval none{0, 0}, all = Interval::everything();
  EXPECT_EQ(none * all, none);
  EXPECT_EQ(all * none, none);
  EXPECT_EQ((Interval{0, 2} * Interval{1, all.high}), (Interval{0, all.high}));
}

}  // namespace
}  // namespace mortise
