// Independent pieces of work: each once and the first exception of any.
#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace mortise {
namespace {

TEST(ForEachIndex, DoesEachOnce) {
  for (const int threads : {1, 2, 5}) {
    std::vector<int> done(100, 0);
    for_each_index(done.size(), threads, [&](std::size_t i) { ++done[i]; });
    EXPECT_EQ(done, std::vector<int>(100, 1));
  }
}

TEST(ForEachIndex, ThrowsWhatOneOfThemThrew) {
  for (const int threads : {1, 3}) {
    const auto work = [](std::size_t i) {
      if (i == 7) throw std::runtime_error("seven");
    };
    EXPECT_THROW(for_each_index(20, threads, work), std::runtime_error);
  }
}

}  // namespace
}  // namespace mortise
