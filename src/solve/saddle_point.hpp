// The saddle-point system of contact: K u + B^T lambda = f, B u = g, with some unknowns prescribed.
#pragma once

#include "solve/bordered_cholesky.hpp"

namespace mortise {

/// Unknowns come in pairs (2 i, 2 i + 1: one node). Any units: the system is made dimensionless by the two scales.
struct SaddlePointSystem {
  const SparseMatrix& K;           ///< n x n, lower triangle, positive semidefinite, stress units
  const VecX& f;                   ///< n, force per thickness
  const SparseMatrix& B;           ///< m x n, length
  const VecX& g;                   ///< m, length^2
  const std::vector<char>& fixed;  ///< n: unknowns whose value is prescribed
  const VecX& value;               ///< n, length
  double stiffness_scale;          ///< a typical entry of K (Young's modulus)
  const VecX& row_scale;           ///< m: size of each row of B, length
  /// Unknowns that springs must hold for K to be positive definite (one for each motion that only B resists). The
  /// springs are taken out again exactly: docs/theory.md eq. 18.
  std::vector<int> grounded;
};

struct SaddlePointSolution {
  enum class Status { solved, not_positive_definite, dependent_constraints };
  Status status = Status::solved;
  int failed_at = -1;  ///< the unknown of K, or the row of B, where it is not `solved`

  VecX u;       ///< n, length
  VecX lambda;  ///< m, stress
  /// Largest entry of f - K u - B^T lambda over that of its terms, on free unknowns; and of B u - g (each row over
  /// its scale) over the largest displacement.
  double force_residual = 0, constraint_residual = 0;
  double factorise_seconds = 0, solve_seconds = 0;
  std::size_t factor_bytes = 0;
};

SaddlePointSolution solve_saddle_point(const SaddlePointSystem& system);

}  // namespace mortise
