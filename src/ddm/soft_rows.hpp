// The system of the multipliers where each row gives way, factorised.
#pragma once

#include <Eigen/Cholesky>
#include <optional>

#include "solve/bordered_cholesky.hpp"
#include "solve/contact_rows.hpp"

namespace mortise {

/// [C + D, H; H^T, 0] with D > 0 on unilateral rows: what a step of the interior point solves. The path leads through
/// systems that no iteration preconditioned for closed rows ends on, as D spans some twenty orders, so they are
/// factorised: C + D as a sparse matrix, as C has entries only between rows of one part, and none of soft rows
/// (far_more); what that leaves of the motions, H^T (C + D)^-1 H, as a dense one.
class SoftRows {
 public:
  /// `system`: DualSystem::matrix, of `rows` rows.
  SoftRows(const SparseMatrix& system, Eigen::Index rows);

  /// D, rows. False where C + D is singular.
  bool factorise(const VecX& compliance);
  /// To round-off.
  ContactRows::Forces solve(const VecX& gap, const VecX& work) const;

 private:
  // What the rows do against each motion alone.
  VecX stiffness() const;
  // (gap, work) -> (lambda, mu) by the factors.
  VecX solved(const VecX& rhs) const;

  SparseMatrix matrix_;  // lower triangle, with a diagonal
  VecX own_;             // its diagonal without D
  VecX row_sums_;        // of the absolute values of C
  VecX unit_;            // of gaps and work: the root of a row's compliance, of a motion's stiffness
  Eigen::Index rows_;
  VecX scale_;  // of both in the factors, whose diagonals are then of unit size
  std::optional<BorderedCholesky> factor_;
  Eigen::LLT<MatX> motions_;
};

}  // namespace mortise
