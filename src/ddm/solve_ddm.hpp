// Domain decomposition: each body solved alone, the interface brought to agreement by iteration.
#pragma once

#include "ddm/interface.hpp"

namespace mortise {

struct DdmOptions {
  Scheme scheme = Scheme::neumann_dirichlet;
  Acceleration acceleration = Acceleration::krylov;
  std::optional<double> beta;  ///< default: estimated
  double tolerance = 1e-8;
  int max_iterations = 100;
};

struct DdmSolution {
  /// dependent_row: a group that takes a displacement (the Dirichlet group; in Neumann-Neumann and
  /// Dirichlet-Dirichlet both) does not feel solution.failed_at, a row of B. cannot_open: the multipliers pull
  /// somewhere, and the scheme is for bilateral contact. unheld: contact opens until nothing holds a body. From
  /// not_positive_definite on there is no solution.
  enum class Status { converged, not_converged, diverged, not_positive_definite, dependent_row, cannot_open, unheld };
  Status status = Status::not_converged;
  SaddlePointSolution solution;         ///< of the last iterate; its status is not used
  std::vector<RelaxationStep> history;  ///< of all iterations that were run, one after the other
  double beta = 0;                      ///< as given or estimated; 0 where none is used
  Spectrum spectrum;                    ///< of the iteration with all contact closed, where it was needed
  double factor = 0;                    ///< by which a step reduced the residuals in the end
};

/// Solves the saddle-point system by iterations between two groups of bodies. `dirichlet`: n, the unknowns of the group
/// that takes the displacement; the other group takes the pressure. No row of B may lie within one group.
/// beta is estimated as the best one for the spectrum.
/// Where rows may open, Newton's method finds the closed ones with `krylov`; the other accelerations solve the
/// bilateral problem first and iterate on the projected pressure if that pulls (docs/theory.md, section 11).
DdmSolution solve_by_ddm(const SaddlePointSystem& system, const std::vector<char>& dirichlet, const DdmOptions& options,
                         const StepReport& report = {});

}  // namespace mortise
