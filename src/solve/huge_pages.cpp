#include "solve/huge_pages.hpp"

#include <SuiteSparse_config.h>
#include <sys/mman.h>

#include <cstdlib>

namespace mortise {
namespace {

constexpr std::size_t page = std::size_t(2) << 20;

// As malloc: what it returns may be handed to free() and realloc().
void* malloc_huge(std::size_t size) {
  if (size < 4 * page) return std::malloc(size);
  const std::size_t rounded = (size + page - 1) / page * page;
  void* memory = std::aligned_alloc(page, rounded);
  if (memory) madvise(memory, rounded, MADV_HUGEPAGE);  // refused: then it is plain memory
  return memory;
}

}  // namespace

HugePages::HugePages() : malloc_(SuiteSparse_config.malloc_func) { SuiteSparse_config.malloc_func = malloc_huge; }
HugePages::~HugePages() { SuiteSparse_config.malloc_func = malloc_; }

}  // namespace mortise
