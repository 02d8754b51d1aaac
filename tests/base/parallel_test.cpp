// Independent pieces of work: each once, and the exception of the first that fails.
#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

namespace mortise {
namespace {

TEST(ForEachIndex, DoesEachOnce) {
  for (const int threads : {1, 2, 5}) {
    std::vector<int> done(100, 0);
    for_each_index(done.size(), threads, [&](std::size_t i) { ++done[i]; });
    EXPECT_EQ(done, std::vector<int>(100, 1));
  }
}

TEST(ForEachIndex, KeepsOpenMPToOneThread) {
  for (const int threads : {1, 3})
    for_each_index(20, threads, [](std::size_t) { EXPECT_EQ(omp_get_max_active_levels(), 0); });
}

TEST(ForEachIndex, ThrowsWhatOneThreadWouldThrow) {
  const auto work = [](std::size_t i) {
    if (i == 7) std::this_thread::sleep_for(std::chrono::milliseconds(1));  // 8 and 9 fail before it
    if (i >= 7) throw std::runtime_error(std::to_string(i));
  };
  for (const int threads : {1, 3})
    for (int k = 0; k < 10; ++k) {
      try {
        for_each_index(20, threads, work);
        ADD_FAILURE();
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "7");
      }
    }
}

}  // namespace
}  // namespace mortise
