// Which rows of B are closed: the complementarity problem of unilateral contact, in the multipliers alone.
#pragma once

#include <optional>

#include "solve/multiplier_system.hpp"

namespace mortise {

/// lambda <= 0 and w >= 0 and lambda w = 0 on unilateral rows, w = 0 on the others, where w = r - C lambda - H mu is
/// what is left open of each row (docs/theory.md eq. 24 to 26). Any consistent units.
struct ComplementarityProblem {
  const MatX& compliance;               ///< (m + s) x (m + s), lower triangle, as MultiplierSystem wants it
  const VecX& rhs;                      ///< (r, h), m + s
  const VecX& scale;                    ///< m: lambda_a / scale_a is what is compared with other rows'
  const std::vector<char>& unilateral;  ///< m: rows that may open
  /// A w that is smaller is round-off of what it was computed from, and so are lambda that make no larger w.
  double round_off = 0;
};

/// One solve of the problem.
struct ActiveSetStep {
  int active = 0;          ///< rows, those that cannot open included
  int changed = 0;         ///< rows that are open or closed otherwise in the next step
  double penetration = 0;  ///< largest -w
  double pull = 0;         ///< largest lambda_a / scale_a on a unilateral row
};

struct ActiveSetOptions {
  int max_steps = 100;
  /// Steps that may pass without fewer wrong rows than ever before; then rows change one at a time until there are.
  int patience = 10;
  /// Steps from the start before a guess from joined rows takes over (on loads that change by 1 to 10 % from run to
  /// run, more than 1 save nothing); and rows that are too few to join.
  int start_steps = 1, few_rows = 4;
  /// A row pulls if its lambda_a / scale_a is above this part of the largest, and is penetrated if its -w is above this
  /// part of the largest term of any w: round-off changes no row.
  double pull_tolerance = 1e-10, penetration_tolerance = 1e-11;
};

struct ActiveSetResult {
  /// not_settled: also where the solution is not finite (`wrong` is empty then).
  /// unheld: settled, but the load drives a motion that the closed rows leave loose (`drift`).
  enum class Status { settled, not_settled, dependent_row, unheld };
  Status status = Status::not_settled;
  VecX solution;                     ///< (lambda, mu), m + s
  std::vector<char> active;          ///< m
  std::vector<int> wrong;            ///< rows that the last step would still change
  std::vector<ActiveSetStep> steps;  ///< on all rows
  int coarse_steps = 0;              ///< on joined rows
  int dependent_row = -1;
  VecX drift;                              ///< s: a motion that the load drives and no closed row holds, or zero
  std::optional<MultiplierSystem> system;  ///< of the final active set; its loose motions are zero in `solution`
};

/// The primal-dual active set method, which is a semismooth Newton method (Hintermueller, Ito & Kunisch 2003; for
/// contact Hueeber & Wohlmuth 2005): solve with the active rows closed, then close the rows that are penetrated and
/// open those that pull. w and lambda are linked by a positive definite matrix, but the plain method may still cycle;
/// then rows change one at a time, the first wrong one each time, until fewer are wrong than ever before (Judice &
/// Pires 1994). Where the active rows leave a motion loose, the rows that it closes in the direction of the load become
/// active.
///
/// Deviation: the plain method peels a long closed curve open from its end, a few rows a step. So where its first step,
/// from `start` or all rows closed, is not the solution, the next starts from the active set of a problem with
/// neighbouring rows joined, which is found in the same way, down to a few rows. That makes the number of steps
/// independent of the mesh.
///
/// `start`: m, rows that are active at first, which may be wrong; empty: none known.
ActiveSetResult settle_active_set(const ComplementarityProblem& problem, const std::vector<char>& start = {},
                                  const ActiveSetOptions& options = {});

}  // namespace mortise
