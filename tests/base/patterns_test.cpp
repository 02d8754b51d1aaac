// Names with stars.
#include "base/patterns.hpp"

#include <gtest/gtest.h>

namespace mortise {
namespace {

TEST(Patterns, MatchWithAnyLettersForEachStar) {
  for (const char* pattern : {"*", "brick_*", "*_top", "brick*top", "b*_*_t*", "**", "brick_1_top", "brick_1_top*"})
    EXPECT_TRUE(matches(pattern, "brick_1_top")) << pattern;
  for (const char* pattern : {"", "brick", "brick_*_bed", "*brick", "top*", "b*_*_*_t*", "brick_1_topp*", "*_to"})
    EXPECT_FALSE(matches(pattern, "brick_1_top")) << pattern;
  EXPECT_TRUE(matches("*aab", "aaaab"));
  EXPECT_TRUE(is_pattern("a*") && !is_pattern("a"));
}

}  // namespace
}  // namespace mortise
