// The bordered matrix of some unknowns: what BorderedCholesky factorises.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace mortise {

/// Stiffness and contact rows as they come from the bodies. Unknowns come in pairs (2 i, 2 i + 1: one node).
struct ContactSystem {
  const SparseMatrix& K;           ///< n x n, lower triangle, positive semidefinite, stress units
  const SparseMatrix& B;           ///< m x n, length
  const std::vector<char>& fixed;  ///< n: unknowns that are left out
  double stiffness_scale;          ///< a typical entry of K (Young's modulus)
  const VecX& row_scale;           ///< m: size of each row of B, length
  /// Unknowns that springs hold, so that K is positive definite (one for each motion that only B resists).
  const std::vector<int>& grounded;
};

/// The system on the free unknowns, dimensionless, as BorderedCholesky wants it: the border is the rows of B and one
/// unit row for each spring.
struct BorderedSystem {
  SparseMatrix matrix;
  std::vector<int> free;    ///< reduced -> full
  std::vector<int> blocks;  ///< reduced -> node, densely numbered
};

BorderedSystem bordered_system(const ContactSystem& system);

}  // namespace mortise
