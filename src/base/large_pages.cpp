#include "base/large_pages.hpp"

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

namespace mortise {

void use_large_pages() {
  constexpr int largest_block = 32 << 20;  // that glibc takes from the heap (mallopt(3), M_MMAP_THRESHOLD)
  constexpr int reserve = 1 << 30;         // of addresses, the largest power of 2 that mallopt takes
  rlimit addresses{};
  if (getrlimit(RLIMIT_AS, &addresses) != 0 || addresses.rlim_cur != RLIM_INFINITY) return;

  mallopt(M_ARENA_MAX, 1);
  mallopt(M_MMAP_THRESHOLD, largest_block);
  mallopt(M_TRIM_THRESHOLD, -1);  // never
  mallopt(M_TOP_PAD, reserve);
  auto* const before = static_cast<char*>(sbrk(0));
  void* volatile const block = std::malloc(largest_block / 2);  // volatile: or the compiler drops both lines
  std::free(block);
  mallopt(M_TOP_PAD, largest_block);
  const auto grown = static_cast<char*>(sbrk(0)) - before;
  if (grown > 0) madvise(before, std::size_t(grown), MADV_HUGEPAGE);
}

}  // namespace mortise
#else
void mortise::use_large_pages() {}
#endif
