// Block SSOR for saddle-point systems (MSSOR), plain or as a preconditioner: the iterative alternative to
// solve_directly, for contact that stays closed.
#pragma once

#include "solve/saddle_point_system.hpp"

namespace mortise {

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
/// the smallest seen; in_tension: a unilateral row is in tension.
/// Figures of the iteration: omega, tau and, of the stationary method, tau_limit (preprint_solvers/tau_limit.hpp).
Solution solve_by_mssor(const SaddlePointSystem& system, const MssorOptions& options);

}  // namespace mortise
