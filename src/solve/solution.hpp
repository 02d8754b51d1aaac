// What every solver returns: one status, one solution, one record of an iteration.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/types.hpp"
#include "model/choices.hpp"

namespace mortise {

/// How a solver ended, and what is valid then; "-": do not look at it.
///
///   status                 u, lambda, active, residuals    failed_at        driven_mode
///   ---------------------  ------------------------------  ---------------  ---------------------------
///   converged              the solution                    -                -
///   not_converged          the last iterate                -                -
///   diverged               the same, maybe not finite      -                -
///   not_positive_definite  -                               unknown of K     -
///   dependent_row          -                               row of B         -
///   unconstrained          -                               -                the motion
///   in_tension             -                               -                -
///
/// dependent_row: the contact condition follows from the others. unconstrained: the load drives a body away until
/// nothing holds it. in_tension: contact should open, which this method cannot do.
enum class SolveStatus {
  converged,
  not_converged,
  diverged,
  not_positive_definite,
  dependent_row,
  unconstrained,
  in_tension
};

/// How far an iterate is from the solution, both relative.
struct Residuals {
  double kinematic;  ///< of the displacements
  double force;      ///< of the pressures
  double largest() const { return mortise::largest(kinematic, force); }
};

/// One iterate, before the step that was taken from it.
struct IterationStep {
  Residuals residuals;
  double beta = 0;     ///< relaxation of the step; 0 where there is none
  double seconds = 0;  ///< since the start
};

/// How an iterative method went: what is printed and written of any.
struct Iteration {
  std::string method;  ///< "mssor", "neumann_dirichlet", ...
  Acceleration acceleration;
  std::string settings;  ///< the others, in words, and what they converge for; may be empty
  std::string advice;    ///< where it did not converge: what would; may be empty
  double tolerance;      ///< of both residuals
  int steps = 0;
  /// By which a step multiplied the residual in the end: geometric mean over the last half of the steps.
  double convergence_rate = 0;
  std::vector<IterationStep> history;
  std::vector<std::pair<std::string, double>> figures;  ///< of this method, by name (docs/files.md)
};

/// One solve of the contact problem with given closed rows.
struct ActiveSetStep {
  int active = 0;          ///< rows, those that cannot open included
  int changed = 0;         ///< rows that are open or closed otherwise in the next step
  double penetration = 0;  ///< largest -w; of a Solution: length
  double tension = 0;      ///< largest lambda_a / scale_a on a unilateral row; of a Solution: stress
};

class ContactFactor;

struct Solution {
  Solver solver = Solver::direct;  ///< that found it
  SolveStatus status = SolveStatus::not_converged;
  int failed_at = -1;
  VecX driven_mode;    ///< the grounded unknowns in the rigid motion that the load drives
  std::string advice;  ///< where there is no solution: what this method expects; may be empty

  VecX u;                    ///< n, length
  VecX lambda;               ///< m, stress
  VecX compression;          ///< l, of the surface layers, length
  VecX unbalanced;           ///< n: f - K u - B^T lambda, force; empty: not measured of the whole system
  std::vector<char> active;  ///< m: the rows that are closed
  /// A column a rigid motion that no closed row holds and no load drives: the grounded unknowns in it; it is 0 in u, or
  /// what springs left there (solve/active_set.hpp).
  MatX rigid_modes;
  /// Largest entry of f - K u - B^T lambda, on free unknowns, over the largest entry of its terms or, if that is more,
  /// over rigid_part of |K| |u| in the same row; and of B u - g (each closed row over its scale) over the largest
  /// displacement. NaN where u, lambda or one of these terms is not finite.
  double force_residual = 0, constraint_residual = 0;
  double force_tolerance = 1e-10, constraint_tolerance = 1e-10;  ///< what the method was asked for

  int layer_steps = 0;                 ///< linear layers, one after another, where their laws are not
  std::vector<ActiveSetStep> steps;    ///< one a solve of the contact problem
  int coarse_steps = 0;                ///< solves on coarse rows, to start from
  int interior_steps = 0;              ///< of the interior point, a factorisation each
  std::vector<int> infeasible;         ///< rows that the last step would still change
  std::optional<Iteration> iteration;  ///< where the method iterates
  double factorise_seconds = 0, solve_seconds = 0;
  std::shared_ptr<const ContactFactor> factor;  ///< of the closed rows, where the method has one
};

}  // namespace mortise
