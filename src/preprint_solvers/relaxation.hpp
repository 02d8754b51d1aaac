// Fixed-point iterations x := x + beta z(x), and ways to make them faster.
#pragma once

#include <functional>

#include "solve/solution.hpp"

namespace mortise {

struct RelaxationOptions {
  Acceleration acceleration = Acceleration::krylov;
  double beta = 1;  ///< relaxation; of accelerated iterations that of the first step. > 0
  double tolerance = 1e-8;
  int max_iterations = 100;  ///< evaluations of z
};

struct RelaxationResult {
  SolveStatus status = SolveStatus::not_converged;  ///< or converged, diverged
  VecX x;                                           ///< the last iterate
  std::vector<IterationStep> history;               ///< one an evaluation of z
  double convergence_rate = 0;                      ///< of z, as Iteration::convergence_rate
};

using Correction = std::function<VecX(const VecX& x)>;                   ///< z(x), zero at the solution
using Measure = std::function<Residuals(const VecX& x, const VecX& z)>;  ///< of an iterate

/// Iterates from x until the largest residual is below the tolerance, or z is 1e6 times the smallest seen or not
/// finite (diverged).
///   none      x += beta z
///   aitken    beta from the last two corrections (Kuettler & Wall 2008)
///   anderson  least squares over all corrections so far (Anderson 1965), which is IQN-ILS (Degroote, Bathe &
///             Vierendeels 2009) for beta = 1
///   krylov    GCR (Eisenstat, Elman & Schultz 1983), the iterates of GMRES; z must be affine in x
/// Deviation: Anderson leaves out columns that are combinations of newer ones to 1e-10.
RelaxationResult relax(const Correction& correction, const Measure& measure, VecX x, const RelaxationOptions& options);

}  // namespace mortise
