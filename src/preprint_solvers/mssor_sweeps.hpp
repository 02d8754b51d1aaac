// The two matrices of a block SSOR method for saddle-point systems: A itself, and the M that a step inverts.
#pragma once

#include <vector>

#include "solve/saddle_point_system.hpp"

namespace mortise {

/// [K B^T; B 0] (u, lambda) = (f, g) on the n free unknowns in band_order, all rows closed; dimensionless: K over the
/// stiffness scale, rows of B and g over theirs, so f, u and g are lengths, and lambda is in units of stiffness /
/// scale.
struct SweepSystem {
  std::vector<int> unknown;        ///< n: the k-th one's number in the system that was given
  VecX D, D_inverse;               ///< n: diagonal of K, and one over it
  std::vector<int> start, column;  ///< n + 1, entries: the strict lower triangle L of K = D + L + L^T by rows
  std::vector<double> value;       ///< entries
  Eigen::SparseMatrix<double, Eigen::RowMajor> B;  ///< m x n
  VecX rhs;                                        ///< n + m: (f, g)
  double largest_value = 0;                        ///< largest prescribed displacement
  /// S = B D^-1 B^T = S_lower diag(S_pivots) S_lower^T, m x m, in the order of the rows; the unit diagonal is left out.
  SparseMatrix S_lower;
  VecX S_pivots;
  int not_positive = -1;   ///< an unknown (as given) whose diagonal is not positive; the sweeps may not be called then
  int dependent_row = -1;  ///< a row that the others imply, likewise

  Eigen::Index n() const { return D.size(); }
  Eigen::Index m() const { return B.rows(); }
};

SweepSystem sweep_system(const SaddlePointSystem& system);

/// y = A x; both n + m.
void multiply(const SweepSystem& s, const VecX& x, VecX& y);

/// x := Q^-1 x, n; Q = (D + omega L) D^-1 (D + omega L^T) / (omega (2 - omega)), the SSOR splitting of K. 0 < omega
/// < 2.
void solve_Q(const SweepSystem& s, double omega, VecX& x);

/// x := S^-1 x, m.
void solve_S(const SweepSystem& s, VecX& x);

/// M = [Q 0; B -S/tau] [I Q^-1 B^T; 0 I] of docs/theory.md eq. 36, or its blocks diag(Q, S/tau) alone, with their work
/// space.
struct SweepPreconditioner {
  const SweepSystem& system;
  double omega, tau;
  VecX first = VecX(system.n()), second = VecX(system.n()), row = VecX(system.m());  ///< work space

  /// z = M^-1 r, n + m: the step of the stationary method from the residual r. z must not be r.
  void solve(const VecX& r, VecX& z);
  /// z = diag(Q, S/tau)^-1 r.
  void solve_blocks(const VecX& r, VecX& z);
};

}  // namespace mortise
