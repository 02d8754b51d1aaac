#include "solve/threads.hpp"

#include <omp.h>

#include <algorithm>
#include <thread>

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
  omp_set_max_active_levels(0);
  if (openblas_get_num_threads() != 1) openblas_set_num_threads(1);  // a call of no effect, too, wakes its workers
}

}  // namespace mortise
