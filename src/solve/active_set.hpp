// Which rows of B are closed: the complementarity problem of unilateral contact, in the multipliers alone.
#pragma once

#include "solve/complementarity_problem.hpp"
#include "solve/multiplier_system.hpp"
#include "solve/solution.hpp"

namespace mortise {

struct ActiveSetOptions {
  int max_steps = 100;
  /// Steps that may pass without fewer infeasible rows than ever before; then rows change one at a time until there
  /// are (the safeguard of Judice & Pires 1994).
  int max_stalled_steps = 10;
  /// Steps from the start before a guess from coarse rows takes over (on loads that change by 1 to 10 % from run to
  /// run, more than 1 save nothing); and rows that are too few to coarsen.
  int start_steps = 1, few_rows = 4;
  /// A row is in tension if its lambda_a / scale_a is above this part of the largest, and is penetrated if its -w is
  /// above this part of the largest term of any w: round-off changes no row.
  double tension_tolerance = 1e-10, penetration_tolerance = 1e-11;
};

struct ActiveSetResult {
  /// converged, not_converged (also where the solution is not finite: `infeasible` is empty then), dependent_row, or
  /// unconstrained: the load drives a rigid mode of the closed rows.
  SolveStatus status = SolveStatus::not_converged;
  VecX solution;                     ///< (lambda, mu), m + s
  std::vector<char> active;          ///< m
  std::vector<int> infeasible;       ///< rows that the last step would still change
  std::vector<ActiveSetStep> steps;  ///< on all rows
  int coarse_steps = 0;              ///< on coarse rows
  int dependent_row = -1;
  VecX driven_mode;                        ///< s: the rigid mode that the load drives, or zero
  std::optional<MultiplierSystem> system;  ///< of the final active set; its rigid modes are zero in `solution`
};

/// The primal-dual active set method, which is a semismooth Newton method (Hintermueller, Ito & Kunisch 2003; for
/// contact Hueeber & Wohlmuth 2005): solve with the active rows closed, then close the rows that are penetrated and
/// open those in tension. w and lambda are linked by a positive definite matrix, but the plain method may still cycle;
/// then rows change one at a time, the first infeasible one each time, until fewer are infeasible than ever before
/// (Judice & Pires 1994). Where the load drives a rigid mode, the rows that it closes become active.
///
/// Deviation: the plain method peels a long closed curve open from its end, a few rows a step. So where its first step,
/// from `start` or all rows closed, is not the solution, the next starts from the active set of a problem with
/// neighbouring rows joined (coarse_rows), which is found in the same way, down to a few rows. That makes the number of
/// steps independent of the mesh.
///
/// `rhs`: (r, h), m + s. `start`: m, rows that are active at first, which may be wrong; empty: none known.
ActiveSetResult find_active_set(const ComplementarityProblem& problem, const VecX& rhs,
                                const std::vector<char>& start = {}, const ActiveSetOptions& options = {});

}  // namespace mortise
