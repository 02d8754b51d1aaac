// The rows of a contact problem, as the active set and the interior point ask them: solves with given closed rows, or
// with rows that give way.
#pragma once

#include <vector>

#include "base/types.hpp"
#include "solve/solution.hpp"

namespace mortise {

/// lambda <= 0 and w >= 0 and lambda w = 0 on unilateral rows, w = 0 on the others, where w = r - C lambda - H mu is
/// what is left open of each row, and H^T lambda = h (docs/theory.md eq. 24 to 26).
class ContactRows {
 public:
  struct Answer {
    /// converged; not_converged: an iteration inside ended early; or dependent_row: nothing else is valid then.
    SolveStatus status = SolveStatus::converged;
    int dependent_row = -1;
    VecX lambda, mu;  ///< m, s
    VecX w;           ///< m
    /// Largest lambda_a / scale_a, and -w_a, that are round-off.
    double negligible_tension = 0, negligible_penetration = 0;
    VecX driven_mode;  ///< s: the free motion that the load drives and no closed row holds, in its direction, or zero
    VecX opening;      ///< m: H driven_mode
  };
  /// lambda and mu, or what is added to them.
  struct Forces {
    VecX lambda, mu;  ///< m, s
  };

  virtual ~ContactRows() = default;
  /// Of the system [C_AA H_A; H_A^T 0] (lambda_A, mu) = (r, h) with A the closed rows. `at`: s, where a motion that no
  /// closed row holds stays; empty: at zero.
  virtual Answer solve(const std::vector<char>& closed, const VecX& at) = 0;
  /// m: lambda_a / scale_a is what is compared with other rows'.
  virtual const VecX& scale() const = 0;
  /// m: rows that may open.
  virtual const std::vector<char>& unilateral() const = 0;
  /// s: how many free motions there are.
  virtual Eigen::Index motions() const = 0;
  /// m: of C; and s: what all rows side by side do against each motion, diagonal of H^T diagonal^-1 H.
  virtual VecX diagonal() const = 0;
  virtual VecX stiffness() const = 0;
  /// m x s: H.
  virtual MatX openings() const = 0;
  /// w, m, and h - H^T lambda, s: zero for none of both vectors.
  virtual VecX gaps(const Forces& forces) const = 0;
  virtual VecX unbalanced(const VecX& lambda) const = 0;
  /// From now on each row gives way by `compliance` (m, >= 0) times its lambda, and one that gives way far more than
  /// the bodies do presses on motions alone. False where there is no such system.
  virtual bool soften(const VecX& compliance) = 0;
  /// [C + compliance, H; H^T 0] (lambda, mu) = (gap, work).
  virtual Forces solve_softened(const VecX& gap, const VecX& work) = 0;
  /// Where solve() iterates: to less from now on. False where there is nothing to gain.
  virtual bool refine() { return false; }
  /// s x count: the motions that none of the closed rows of the last solve holds, told_apart.
  virtual MatX free_motions() const = 0;
};

/// Of the sum of |C_ab| over all rows b: a row a that gives way by more is soft. What is left out between soft rows and
/// all others then changes their pressures by a tenth at most (Gershgorin 1931), and is solved for again (refine.hpp).
inline constexpr double far_more = 10;

/// What a row's unit normal is off by: places are drawn to gmsh's Geometry.Tolerance, 1e-8 of the size, and turn an
/// edge of a tenth of it so much. Pressures do so much work on motions that should not feel them, such as a disc's
/// spin.
inline constexpr double normal_noise = 1e-7;

}  // namespace mortise
