// Block SSOR for saddle-point systems (MSSOR), plain or as a preconditioner: the iterative alternative to
// solve_saddle_point, for contact that stays closed.
#pragma once

#include "base/model.hpp"
#include "solve/relaxation.hpp"
#include "solve/saddle_point.hpp"

namespace mortise {

struct MssorOptions {
  double omega = 1.3;                                ///< of the SSOR splitting of K, 0 < omega < 2
  double tau = 0.7;                                  ///< of the step of the multipliers, > 0
  Acceleration acceleration = Acceleration::krylov;  ///< none, krylov or minres
  double tolerance = 1e-10;                          ///< of both residuals
  int max_iterations = 20000;
};

struct MssorSolution {
  /// From not_positive_definite on there is no solution. dependent_row, not_positive_definite: at solution.failed_at.
  /// cannot_open: a unilateral row pulls.
  enum class Status { converged, diverged, not_converged, not_positive_definite, dependent_row, cannot_open };
  Status status = Status::not_converged;
  SaddlePointSolution solution;
  int steps = 0;                   ///< evaluations of M^-1, or of its blocks
  std::vector<Residuals> history;  ///< before each step, and at the end
  double factor = 0;      ///< by which a step multiplied the residual (Euclidean norm) in the end: geometric mean
  double tau_border = 0;  ///< of acceleration none: tau_border(); else 0
};

/// The stationary method from u = 0, lambda = 0 (prescribed displacements in place) is
///
///   u' = u + Q^-1 (f - K u - B^T lambda)
///   lambda := lambda + tau S^-1 (B u' - g)
///   u := u' - Q^-1 B^T (increment of lambda)
///
/// with the SSOR splitting Q of K and S = B diag(K)^-1 B^T, in the manner of Bychenkov & Chizhonkov (docs/theory.md eq.
/// 35 to 37). That is x := x + M^-1 (b - A x) with a symmetric indefinite M.
///   none    the method as it stands
///   krylov  symmetric QMR with M as preconditioner (Freund & Nachtigal 1994): short recurrences for the symmetric
///           indefinite M and A; needs about as many steps as GMRES, which would keep every direction
///   minres  MINRES (Paige & Saunders 1975), whose preconditioner must be positive definite: diag(Q, S / tau)
/// Converged is what measure_residuals says of u and lambda in the system's own units; diverged: a residual 1e6 times
/// the smallest seen.
MssorSolution solve_by_mssor(const SaddlePointSystem& system, const MssorOptions& options);

}  // namespace mortise
