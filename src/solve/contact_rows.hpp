// Solves of the contact problem with given closed rows, as the active set method asks for them.
#pragma once

#include <vector>

#include "base/types.hpp"
#include "solve/solution.hpp"

namespace mortise {

/// Springs at the free motions, while an active set is looked for. Empty: none; a motion that no row holds is zero
/// then.
struct Supports {
  VecX stiffness;  ///< s
  VecX at;         ///< s: the motions at which the springs are without force
};

/// lambda <= 0 and w >= 0 and lambda w = 0 on unilateral rows, w = 0 on the others, where w = r - C lambda - H mu is
/// what is left open of each row (docs/theory.md eq. 24 to 26).
class ContactRows {
 public:
  struct Answer {
    /// converged; not_converged: an iteration inside ended early; or dependent_row: nothing else is valid then.
    SolveStatus status = SolveStatus::converged;
    int dependent_row = -1;
    VecX lambda, mu;  ///< m, s
    VecX w;           ///< m
    /// Largest lambda_a / scale_a, and -w_a, that are round-off.
    double negligible_tension, negligible_penetration;
    /// Largest entry of h - H^T lambda, which the supports carry, over the largest of its terms.
    double supported = 0;
    VecX driven_mode;  ///< s: the free motion that the load drives and no closed row holds, in its direction, or zero
    VecX opening;      ///< m: H driven_mode
  };

  virtual ~ContactRows() = default;
  /// Of the system [C_AA H_A; H_A^T -K] (lambda_A, mu - at) = (r - H at, h) with A the closed rows, K the supports.
  virtual Answer solve(const std::vector<char>& closed, const Supports& supports) = 0;
  /// m: lambda_a / scale_a is what is compared with other rows'.
  virtual const VecX& scale() const = 0;
  /// m: rows that may open.
  virtual const std::vector<char>& unilateral() const = 0;
  /// s: how many free motions there are.
  virtual Eigen::Index motions() const = 0;
  /// s: against each motion, of all rows side by side.
  virtual VecX stiffness() const = 0;
  /// Where solve() iterates: to less from now on. False where there is nothing to gain.
  virtual bool refine() { return false; }
  /// s x count: the motions that none of the closed rows of the last solve holds, told_apart.
  virtual MatX free_motions() const = 0;
};

}  // namespace mortise
