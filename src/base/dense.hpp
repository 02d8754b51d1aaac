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

/// A^-1, likewise.
MatX inverse_of(const MatX& A);

/// Orthonormal columns that span those of a matrix of full column rank.
MatX orthonormal(const MatX& columns);

}  // namespace mortise
