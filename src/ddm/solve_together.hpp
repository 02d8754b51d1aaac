// Sparse triangular solves of several right-hand sides.
#pragma once

#include <Eigen/SparseCholesky>

#include "base/types.hpp"

namespace mortise {

/// factor.solve(b), reading the factor once for all columns of b; Eigen reads it once for each.
MatX solve_together(const Eigen::SimplicialLDLT<SparseMatrix>& factor, const MatX& b);

}  // namespace mortise
