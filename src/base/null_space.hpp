// The null space of a symmetric matrix.
#pragma once

#include "base/types.hpp"

namespace mortise {

/// Orthonormal columns that span the eigenvectors of a positive semidefinite A (both triangles stored) with eigenvalues
/// of at most `limit` > 0. Small matrices by all their eigenvectors; large sparse ones at the cost of a factorisation:
/// the negative pivots of A - limit I count them (Sylvester's law of inertia), inverse iteration finds them.
/// `limit` well above the round-off of A, 1e-16 of its norm.
MatX null_space(const SparseMatrix& A, double limit);

}  // namespace mortise
