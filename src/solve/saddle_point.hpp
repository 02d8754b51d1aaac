// The saddle-point system of contact: K u + B^T lambda = f, with B u = g or, on unilateral rows, B u >= g, lambda <= 0
// and lambda (B u - g) = 0; some unknowns prescribed.
#pragma once

#include "solve/active_set.hpp"
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
  std::vector<int> grounded = {};
  std::vector<char> unilateral = {};  ///< m: rows that may open; empty: none
  std::vector<char> start = {};       ///< m: rows that are closed at first; empty: all
};

/// Forces are compared with this part of stiffness times displacement, |K| |u| in their own row, where they are
/// smaller: those of a body that moves without being deformed are round-off of that product, and so are those in thin
/// elements, whose stiffness is many times the material's (|K| |u| is what Oettli & Prager 1964 compare a residual
/// with).
inline constexpr double rigid_part = 1e-3;

struct SaddlePointSolution {
  /// not_settled: u and lambda are those of the last active set, or are not finite. unheld: only `drift` is given.
  enum class Status { solved, not_positive_definite, dependent_constraints, not_settled, unheld };
  Status status = Status::solved;
  int failed_at = -1;  ///< the unknown of K that is not positive definite, or the row of B that depends on others

  VecX u;                            ///< n, length
  VecX lambda;                       ///< m, stress
  std::vector<char> active;          ///< m: the rows that are closed
  std::vector<ActiveSetStep> steps;  ///< one a solve; penetrations are lengths, pulls are stresses
  int coarse_steps = 0;              ///< solves on joined rows, to start from
  std::vector<int> unsettled;        ///< rows that the last step would still change
  VecX drift;                        ///< where `unheld`: the grounded unknowns in the motion that the load drives
  MatX loose;                        ///< a column a motion that no closed row holds nor load drives: likewise, 0 in u
  /// Largest entry of f - K u - B^T lambda, on free unknowns, over the largest entry of its terms or, if that is more,
  /// over rigid_part of |K| |u| in the same row; and of B u - g (each closed row over its scale) over the largest
  /// displacement. NaN where u, lambda or one of these terms is not finite.
  double force_residual = 0, constraint_residual = 0;
  double factorise_seconds = 0, solve_seconds = 0;
};

/// The grounded unknowns that take part in loose motions: springs hold them, with less than 1e-5 of the forces.
std::vector<int> held_unknowns(const std::vector<int>& grounded, const SaddlePointSolution& solution);

/// Fills the two residuals of u and lambda, where the `active` rows are closed. held_unknowns() have none.
void measure_residuals(const SaddlePointSystem& system, SaddlePointSolution& solution);

SaddlePointSolution solve_saddle_point(const SaddlePointSystem& system);

}  // namespace mortise
