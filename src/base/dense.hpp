// Dense factorisations that several rooms need: instantiated once, which halves the time to compile their users.
#pragma once

#include "base/types.hpp"

namespace mortise {

/// Eigenvalues and vectors of a symmetric matrix, of which the lower triangle is read.
struct SymmetricEigen {
  VecX values;   ///< ascending
  MatX vectors;  ///< orthonormal columns
};
SymmetricEigen symmetric_eigen(const MatX& A);

/// A^-1 b of a square A, by LU with partial pivoting; b where both are empty.
VecX solve_square(const MatX& A, const VecX& b);

}  // namespace mortise
