#include "solve/threads.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>
#include <thread>
#include <vector>

extern "C" {
void openblas_set_num_threads(int threads);
int openblas_get_num_threads();
void* blas_memory_alloc(int);
void blas_memory_free(void*);
}

namespace mortise {
namespace {

constexpr std::size_t blas_buffer = std::size_t(160) << 20;  // bytes; OpenBLAS's are 128 MB on x86

std::atomic<int> requested = 0;  // set by one thread of a program while others solve

// OpenBLAS asks for the buffers of its products, one a thread, again and again where there is no memory, without an
// end: it gets them before there is much else, all or as many as there is memory for.
void reserve_blas_buffers() {
  std::vector<void*> buffers;
  for (int i = 0; i < solver_threads(); ++i) {
    void* room = ::operator new(blas_buffer, std::nothrow);
    ::operator delete(room);
    if (room) buffers.push_back(blas_memory_alloc(0));
  }
  if (buffers.empty()) throw std::bad_alloc();
  for (void* buffer : buffers) blas_memory_free(buffer);
}

}  // namespace

void set_solver_threads(int threads) { requested = threads; }

int solver_threads() {
  static const int cores = int(std::thread::hardware_concurrency());  // which the system looks up in files
  const int asked = requested, wanted = asked > 0 ? asked : cores;
  return std::clamp(wanted, 1, most_threads);
}

void apply_solver_threads() {
  static std::once_flag reserved;
  std::call_once(reserved, reserve_blas_buffers);
  omp_set_max_active_levels(0);
  if (openblas_get_num_threads() != 1) openblas_set_num_threads(1);  // a call of no effect, too, wakes its workers
}

}  // namespace mortise
