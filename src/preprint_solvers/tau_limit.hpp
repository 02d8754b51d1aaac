// The region in which the stationary MSSOR method converges.
#pragma once

#include "preprint_solvers/mssor_sweeps.hpp"

namespace mortise {

/// The stationary method converges for 0 < tau < tau_limit(omega), and for no larger tau (docs/theory.md eq. 38):
///
///   1 / tau_limit = largest eigenvalue of S^-1 (B Q^-1 B^T - B (2 Q - K)^-1 B^T / 2),
///
/// by up to 30 steps of Lanczos' method with full orthogonalisation, (2 Q - K)^-1 by conjugate gradients with the
/// preconditioner Q (eigenvalues in [1, 2]: 1e-9 in 12 steps). Infinity where there are no rows.
double tau_limit(const SweepSystem& system, double omega);

}  // namespace mortise
