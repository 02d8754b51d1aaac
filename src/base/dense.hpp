// Dense factorisations that several rooms need: instantiated once, which halves the time to compile their users.
#pragma once

#include <memory>

#include "base/types.hpp"

namespace mortise {

/// Eigenvalues and vectors of a symmetric matrix, of which the lower triangle is read.
struct SymmetricEigen {
  VecX values;   ///< ascending
  MatX vectors;  ///< orthonormal columns
};
SymmetricEigen symmetric_eigen(const MatX& A);

/// The eigenvalues of a square matrix, in no order (LAPACK's dgeev).
Eigen::VectorXcd eigenvalues(MatX A);

/// A^-1 of a square A, by LU with partial pivoting.
MatX inverse_of(const MatX& A);

/// Orthonormal columns that span those of a matrix of full column rank.
MatX orthonormal(const MatX& columns);

/// Columns that span what A maps to zero (LU with full pivoting): a pivot counts as zero if it is at most `threshold`
/// of the largest, or round-off of it where that is 0.
MatX kernel_of(const MatX& A, double threshold = 0);

/// A = L L^T of a symmetric matrix, of which the lower triangle is read (LAPACK's dpotrf).
class DenseCholesky {
 public:
  DenseCholesky() = default;
  explicit DenseCholesky(MatX A);
  /// The row and column whose pivot is not positive: A is indefinite, and only the rows of L before it are known. -1:
  /// none.
  int failed() const { return failed_; }
  double pivot(Eigen::Index i) const { return L_(i, i); }  ///< of L
  MatX solve(MatX b) const;                                ///< A^-1 b
  MatX lower(MatX b) const;                                ///< L^-1 b
  MatX upper(MatX b) const;                                ///< L^-T b

 private:
  MatX solve_triangle(const char* transposed, MatX b) const;

  MatX L_;
  int failed_ = -1;
};

/// x of the least |A x - b|, by QR with pivoting of the columns.
class LeastSquares {
 public:
  explicit LeastSquares(const MatX& A);
  ~LeastSquares();
  VecX solve(const VecX& b) const;

 private:
  struct Factor;
  std::unique_ptr<const Factor> factor_;
};

}  // namespace mortise
