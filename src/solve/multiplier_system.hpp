// The dense system of the multipliers, on those rows of B that are active.
#pragma once

#include <vector>

#include "base/dense.hpp"

namespace mortise {

/// The system on the active rows A of B, and on the s springs that hold what only contact holds (docs/theory.md eq.
/// 18):
///
///   [C_AA  H_A; H_A^T  0] (lambda_A, mu) = (r_A, h),   lambda = 0 on the other rows.
///
/// Column k of H = B R says how each row opens under the free motion that moves spring k's unknown by 1, and h is the
/// load's work on these motions. Rigid modes are the motions that the active rows do not hold: they do not take part in
/// solve().
class MultiplierSystem {
 public:
  /// `compliance`: (m + s) x (m + s), lower triangle, [C; H^T, .] (BorderedCholesky). `active`: rows below m,
  /// ascending.
  MultiplierSystem(const MatX& compliance, Eigen::Index springs, std::vector<int> active);

  /// A row that the active rows before it already imply, or -1. Nothing below may be called where there is one.
  int dependent_row() const;

  /// (lambda, mu), m + s, for the right-hand side (r, h), m + s.
  VecX solve(const VecX& rhs) const;

  /// s x count: the springs' unknowns in each rigid mode, told_apart.
  const MatX& rigid_modes() const { return rigid_modes_; }
  /// With x = solve(rhs), the rigid mode that the load drives, s, in its direction: H times it is how the rows open.
  /// Zero where the work of the load and the rows is no more than rows do that a motion opens too little to be held by
  /// them. `lambda`: m, of which x is, or corrects, the active rows'.
  VecX driven_mode(const VecX& rhs, const VecX& x, const VecX& lambda) const;

 private:
  // h - H_A^T y: the load's work that the rows' forces y leave.
  VecX unbalanced(const VecX& rhs, const VecX& y) const { return rhs.tail(springs_) - H_.transpose() * y; }
  VecX on_active(const VecX& rhs) const;

  Eigen::Index m_, springs_;
  std::vector<int> active_;
  DenseCholesky cholesky_;   // of C_AA
  VecX diagonal_;            // of C_AA
  MatX H_, reduced_;         // H_A, C_AA^-1 H_A
  MatX held_, rigid_modes_;  // eigenvectors of H_A^T C_AA^-1 H_A
  VecX stiffness_;           // and the eigenvalues of those held
};

}  // namespace mortise
