// Large pages for the factor.
#pragma once

#include <cstddef>

namespace mortise {

/// While it lives, CHOLMOD's large arrays come in huge pages where the kernel grants them on request (Linux,
/// transparent_hugepage = madvise or always). First touches of 4 KiB pages took a fifth of a large factorisation.
class HugePages {
 public:
  HugePages();
  ~HugePages();
  HugePages(const HugePages&) = delete;
  HugePages& operator=(const HugePages&) = delete;

 private:
  void* (*malloc_)(std::size_t);
};

}  // namespace mortise
