// The kernel of the dense products inside the factorisation: which one OpenBLAS runs, and which one it should.
#pragma once

#include <string>

namespace mortise {

/// Gives OpenBLAS the kernel of this processor where it took one below: a release that does not know a processor falls
/// back to SSE3, three times slower (0.3.21 on Intel models after 2022: OpenBLAS issue 4267). Nothing where
/// OPENBLAS_CORETYPE names one, nor on a processor without AVX2. Ends the workers that OpenBLAS starts with, too, which
/// spin before they sleep (20 of the 45 ms of a small scene): they come back where several threads multiply. For
/// main(), before anything is multiplied: both are the whole process's, so the library does not do them to a program
/// that it is part of.
void choose_dense_kernel();

/// "OpenBLAS 0.3.21 SkylakeX".
std::string dense_kernel();

}  // namespace mortise
