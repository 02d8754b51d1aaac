// Independent pieces of work on all cores.
#pragma once

#include <omp.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace mortise {

/// Calls work(i) once for each i below count, on so many threads; in order on one. Throws what one thread would: of all
/// that failed the exception of the least i. Within the work OpenMP has one thread: it would be asked by Eigen and
/// CHOLMOD.
template <typename Work>
void for_each_index(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::size_t failed = count;
  std::mutex mutex;
  const auto run = [&] {
    omp_set_max_active_levels(0);  // a setting of each thread
    std::size_t i = next++;
    try {
      for (; i < count; i = next++) work(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (i < failed) {
        failed = i;
        failure = std::current_exception();
      }
      next = count;
    }
  };
  {
    std::vector<std::jthread> others;
    for (int k = 1; k < threads && k < int(count); ++k) others.emplace_back(run);
    run();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace mortise
