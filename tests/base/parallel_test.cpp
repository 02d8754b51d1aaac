// Independent pieces of work: each once, the first exception of any, and threads that know that they are several.
#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace mortise {
namespace {

TEST(ForEachIndex, DoesEachOnceAndKnowsWhetherOthersWork) {
  for (const int threads : {1, 2, 5}) {
    std::vector<int> done(100, 0), several(100, 0);
    for_each_index(done.size(), threads, [&](std::size_t i) {
      ++done[i];
      several[i] = in_parallel;
    });
    EXPECT_EQ(done, std::vector<int>(100, 1));
    EXPECT_EQ(several, std::vector<int>(100, threads > 1));
    EXPECT_FALSE(in_parallel);
  }
}

TEST(ForEachIndex, ThrowsWhatOneOfThemThrew) {
  for (const int threads : {1, 3}) {
    const auto work = [](std::size_t i) {
      if (i == 7) throw std::runtime_error("seven");
    };
    EXPECT_THROW(for_each_index(20, threads, work), std::runtime_error);
    EXPECT_FALSE(in_parallel);
  }
}

}  // namespace
}  // namespace mortise
