// Eigenvalues by LAPACK: Eigen's solvers would be instantiated in each test that asks.
#pragma once

#include "base/types.hpp"

namespace mortise::test {

/// Largest modulus of the eigenvalues of a square matrix.
double spectral_radius(MatX A);

/// Moduli of the eigenvalues of a square matrix, in no order.
VecX eigenvalue_moduli(MatX A);

}  // namespace mortise::test
