#include "solve/threads.hpp"

#include <omp.h>

#include <algorithm>
#include <thread>

#include "base/parallel.hpp"

extern "C" void openblas_set_num_threads(int threads);

namespace mortise {
namespace {

// Below, the small blocks' threads wait for each other longer than they work, and far longer on a busy machine.
constexpr double worth_threads = 5e9;

int requested = 0;

}  // namespace

void set_solver_threads(int threads) { requested = threads; }

int solver_threads() { return requested > 0 ? requested : int(std::max(1u, std::thread::hardware_concurrency())); }

void apply_solver_threads(double operations) {
  omp_set_max_active_levels(0);  // CHOLMOD's own OpenMP loops and OpenBLAS's threads fight for the cores
  const bool worth = !in_parallel && (requested > 0 || operations > worth_threads);
  openblas_set_num_threads(worth ? solver_threads() : 1);
}

}  // namespace mortise
