// The dual problem with given rows closed: its coarse problem, its preconditioner, its conjugate gradients.
#pragma once

#include <Eigen/SparseCholesky>
#include <optional>
#include <span>

#include "ddm/dual_system.hpp"
#include "solve/iteration_monitor.hpp"

namespace mortise {

/// lambda, m, zero on open rows; mu, s. A column each of several.
struct DualSolution {
  MatX lambda, mu;
};

class ClosedRows {
 public:
  /// Keeps a reference to `system`.
  ClosedRows(const DualSystem& system, const std::vector<char>& closed);

  /// A closed row that the others imply, or -1. Nothing below may be called where there is one.
  int dependent_row = -1;
  /// s x count: the springs' unknowns in each motion that no closed row holds, told_apart.
  MatX free_motions;

  /// Projected, preconditioned conjugate gradients from `x`, column by column until its monitor ends them: lambda in
  /// balance with forces.h, [C H] x = forces.r on closed rows. The residuals: what is left open over the largest
  /// displacement; and the error of lambda in the norm of C, estimated by the preconditioner, over that of the
  /// displacements. Free motions are zero in mu.
  void solve(const DualSystem::Forces& forces, std::span<IterationMonitor> monitors, DualSolution& x) const;

  /// The free motions that the work h of forces drives, in their direction, s: the work that lambda leaves, where it is
  /// more than round-off of its terms.
  VecX driven_motion(const VecX& h, const VecX& lambda) const;

 private:
  struct Columns;
  MatX on_closed(const MatX& v) const { return closed_.asDiagonal() * v; }
  MatX coarse(MatX b) const;
  MatX balanced(MatX lambda, const MatX& h) const;
  MatX motions(const MatX& residual) const;
  MatX without_motions(MatX residual) const;
  MatX without_resultants(MatX lambda) const;
  MatX stiffened(const MatX& jump) const;
  MatX precondition(const MatX& residual) const;
  std::vector<Residuals> residuals(const Columns& at) const;
  MatX unshared(const MatX& jump) const;
  void share_jumps(const std::vector<char>& closed);
  std::vector<int> springs_left_free(const SparseMatrix& E, const VecX& size);
  void hold_motions();

  using SparseCholesky = Eigen::SimplicialLDLT<SparseMatrix>;

  const DualSystem& system_;
  std::vector<SomeRows> of_parts_;  // DualSystem::closed_of_parts
  VecX closed_;                     // 1 or 0
  VecX weights_;                    // of closed rows: about the inverse of C's diagonal
  std::vector<int> free_;           // springs whose motions no closed row holds
  SparseCholesky sharing_, coarse_;
  std::optional<SlenderInverse> slender_;
  VecX compact_;  // 1 or 0: rows that slender parts do not see; empty where there are none of these
};

}  // namespace mortise
