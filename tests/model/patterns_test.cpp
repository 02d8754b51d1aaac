// Names with stars.
#include "model/patterns.hpp"

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

TEST(Patterns, ShareANameWhereSomeNameMatchesBoth) {
  for (const auto& [first, second] : {std::pair{"a", "a"},
                                      {"a*", "abc"},
                                      {"a*", "*c"},
                                      {"*", "*"},
                                      {"*b*", "a*c"},
                                      {"brick_*", "*_3"},
                                      {"*a", "a*"},
                                      {"", "*"},
                                      {"a**b", "ab"}})
    EXPECT_TRUE(share_a_name(first, second) && share_a_name(second, first)) << first << " " << second;
  for (const auto& [first, second] : {std::pair{"a", "b"},
                                      {"a*", "b*"},
                                      {"*a", "*b"},
                                      {"a*b", "a"},
                                      {"a*c", "abd"},
                                      {"", "a"},
                                      {"brick_*", "stone_3"}})
    EXPECT_FALSE(share_a_name(first, second) || share_a_name(second, first)) << first << " " << second;
}

}  // namespace
}  // namespace mortise
