// The tests run with the heap and the kernel that the program runs with, or with the kernel that OPENBLAS_CORETYPE
// names.
#include "base/large_pages.hpp"
#include "solve/dense_kernel.hpp"

namespace mortise::test {

const bool process_chosen = (use_large_pages(), choose_dense_kernel(), true);

}  // namespace mortise::test
