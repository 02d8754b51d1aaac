// The dual problem with given rows closed: its coarse problem, its preconditioner, its conjugate gradients.
#pragma once

#include <Eigen/SparseCholesky>
#include <optional>

#include "ddm/dual_system.hpp"
#include "solve/iteration_monitor.hpp"

namespace mortise {

/// lambda, m, zero on open rows; mu, s. Both on all ranks.
struct DualSolution {
  VecX lambda, mu;
};

class ClosedRows {
 public:
  /// Keeps a reference to `system`.
  ClosedRows(const DualSystem& system, const std::vector<char>& closed);

  /// A closed row that the others imply, or -1. Nothing below may be called where there is one.
  int dependent_row = -1;
  /// s x count: the springs' unknowns in each motion that no closed row holds, told_apart.
  MatX free_motions;

  /// Projected, preconditioned conjugate gradients from `x`, until the monitor ends them: lambda in balance with
  /// forces.h, [C H] x = forces.r on closed rows. The residuals: what is left open over the largest displacement; and
  /// the error of lambda in the norm of C, estimated by the preconditioner, over that of the displacements. Free
  /// motions are zero in mu.
  void solve(const DualSystem::Forces& forces, IterationMonitor& monitor, DualSolution& x) const;

  /// The free motions that the work h of forces drives, in their direction, s: the work that lambda leaves, where it is
  /// more than round-off of its terms.
  VecX driven_motion(const VecX& h, const VecX& lambda) const;

 private:
  VecX on_closed(const VecX& v) const { return closed_.cwiseProduct(v); }
  VecX coarse(VecX b) const;
  VecX balanced(VecX lambda, const VecX& h) const;
  VecX motions(const VecX& residual) const;
  VecX without_motions(VecX residual) const;
  VecX without_resultants(VecX lambda) const;
  VecX stiffened(const VecX& jump) const;
  VecX precondition(const VecX& residual) const;
  VecX openings(const VecX& motion) const;
  VecX resultants(const VecX& lambda) const;
  VecX unshared(const VecX& jump) const;
  void share_jumps(const std::vector<char>& closed);
  std::vector<int> springs_left_free(const SparseMatrix& E, const VecX& size);
  void hold_motions();

  using SparseCholesky = Eigen::SimplicialLDLT<SparseMatrix>;

  // Vectors of the iteration have the own rows.
  const DualSystem& system_;
  const DealtRows& rows_;
  std::vector<SomeRows> of_parts_;  // DualSystem::closed_of_parts
  VecX closed_;                     // 1 or 0
  VecX weights_;                    // of closed rows: about the inverse of C's diagonal
  std::vector<int> free_;           // springs whose motions no closed row holds
  SparseCholesky sharing_, coarse_;
  std::optional<SlenderInverse> slender_;
  VecX compact_;  // 1 or 0: own rows that slender parts do not see; empty where there are none of these
};

}  // namespace mortise
