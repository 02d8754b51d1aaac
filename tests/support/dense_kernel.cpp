// The tests run with the kernel that the program runs with, or with the one that OPENBLAS_CORETYPE names.
#include "solve/dense_kernel.hpp"

namespace mortise::test {

const bool dense_kernel_chosen = (choose_dense_kernel(), true);

}  // namespace mortise::test
