// Which rows of B are closed: the complementarity problem of unilateral contact, in the multipliers alone.
#pragma once

#include "solve/complementarity_problem.hpp"
#include "solve/contact_rows.hpp"
#include "solve/multiplier_system.hpp"
#include "solve/saddle_point_system.hpp"

namespace mortise {

struct ActiveSetOptions {
  /// Steps of the plain method, and those that may pass without fewer infeasible rows than ever before, until the
  /// interior point takes over; and after that.
  int max_steps = 20, max_stalled_steps = 3, settling_steps = 20;
  /// Steps from the start before a guess from coarse rows takes over (on loads that change by 1 to 10 % from run to
  /// run, more than 1 save nothing); and rows that are too few to coarsen.
  int start_steps = 1, few_rows = 4;
};

struct ActiveSetResult {
  /// converged, dependent_row, unconstrained: no pressures carry the load, and driven_mode proves it; or not_converged:
  /// the solution is not finite, an iteration inside ended early, or rows still change after all steps.
  SolveStatus status = SolveStatus::not_converged;
  VecX lambda, mu;                   ///< m, s
  std::vector<char> active;          ///< m
  std::vector<int> infeasible;       ///< rows that the last step would still change
  std::vector<ActiveSetStep> steps;  ///< on all rows
  int coarse_steps = 0;              ///< on coarse rows
  int interior_steps = 0;            ///< of the interior point
  int dependent_row = -1;
  double negligible_tension = 0;  ///< of the last solve, as of ContactRows::Answer
  /// s: motions that open no closed row and on which the load works (Farkas' lemma), or zero.
  VecX driven_mode;
  MatX free_motions;  ///< s x count: that the final active set does not hold, told_apart
  /// Where the multipliers' system is dense: that of the final active set.
  std::optional<MultiplierSystem> system;
};

/// The primal-dual active set method, which is a semismooth Newton method (Hintermueller, Ito & Kunisch 2003; for
/// contact Hueeber & Wohlmuth 2005): solve with the active rows closed, then close the rows that are penetrated and
/// open those in tension. Where the load drives a rigid mode, the rows that it closes become active. The method is fast
/// and may go round in circles; where it does, find_interior_point says which rows are closed, and the active set of
/// these is a few steps from the solution. Where there is none, motions are found that prove it (nonnegative_fit.hpp).
///
/// `start`: m, rows that are active at first, which may be wrong.
ActiveSetResult find_active_set(ContactRows& rows, std::vector<char> start, const ActiveSetOptions& options = {});

/// The same where the multipliers' system is dense.
///
/// Deviation: the plain method peels a long closed curve open from its end, a few rows a step. So where its first step,
/// from `start` or all rows closed, is not the solution, the next starts from the active set of a problem with
/// neighbouring rows joined (coarse_rows), which is found in the same way, down to a few. That makes the number of
/// steps independent of the mesh.
///
/// A correction (problem.known) starts from the known multipliers and `start`, and takes steps that lower the energy.
///
/// `rhs`: (r, h), m + s. `start`: empty: none known.
ActiveSetResult find_active_set(const ComplementarityProblem& problem, const VecX& rhs,
                                const std::vector<char>& start = {}, const ActiveSetOptions& options = {});

/// Whether an open row is penetrated by the solution's own u, or a closed one in tension by its lambda: exact where
/// springs against unbalanced loads leave round-off in the multipliers' system (slender bodies, rollers without load).
/// `tension`: that is round-off, stress.
bool is_infeasible(const SaddlePointSystem& system, const Solution& solution, double tension);

/// Adds what the method found of the system's rows, in its units but for lambda and u.
void take_active_set(const SaddlePointSystem& system, const ActiveSetResult& set, Solution& solution);

}  // namespace mortise
