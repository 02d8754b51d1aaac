#include "solve/threads.hpp"

#include <omp.h>

#include <algorithm>
#include <thread>

#include "base/parallel.hpp"

extern "C" {
void openblas_set_num_threads(int threads);
int openblas_get_num_threads();
}

namespace mortise {
namespace {

int requested = 0;

}  // namespace

void set_solver_threads(int threads) { requested = threads; }

int solver_threads() { return requested > 0 ? requested : int(std::max(1u, std::thread::hardware_concurrency())); }

void apply_solver_threads() {
  omp_set_max_active_levels(0);  // CHOLMOD's own OpenMP loops and OpenBLAS's threads fight for the cores
  const int threads = in_parallel ? 1 : std::max(1, requested);
  if (openblas_get_num_threads() != threads)
    openblas_set_num_threads(threads);  // even of the same number wakes workers
}

}  // namespace mortise
