// One sparse Cholesky factorisation from which a saddle-point system is solved exactly.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace mortise {

/// The m of the bordered matrix: far above anything that a border of unit size leaves of it.
inline constexpr double border_diagonal = 1e20;

/// Cholesky factor L of a positive definite K, with C = B K^-1 B^T as a by-product (docs/theory.md eq. 15 to 17).
///
/// CHOLMOD factorises the bordered matrix [K B^T; B m I], the border ordered last and m too large to matter, and the
/// border's rows of the factor are V^T with V = L^-1 B^T, whatever m is. So C = V^T V costs one dense product, and a
/// solve with any multipliers one forward and one backward substitution.
/// Deviation from the textbook range-space method (Benzi, Golub & Liesen 2005, section 5), which takes one
/// back-substitution a multiplier to form C.
class BorderedCholesky {
 public:
  /// `matrix` is the upper triangle of [K B^T; B m I] (which spares CHOLMOD a transposition): n columns of K, then the
  /// columns of B^T with border_diagonal below them. K and the rows of B are of about unit size. It is freed once
  /// factorised.
  /// `blocks` groups the n unknowns that share a node (ascending, 0, 0, 1, 1, 2, ...): ordered together.
  BorderedCholesky(SparseMatrix matrix, const std::vector<int>& blocks);
  ~BorderedCholesky();
  BorderedCholesky(BorderedCholesky&&) noexcept;

  /// -1, or the unknown at which K turned out not to be positive definite: nothing below may be called then.
  int failed_at() const;

  /// C = B K^-1 B^T, m x m, lower triangle.
  const MatX& border_compliance() const;

  /// f: n. Keeps y = L^-1 f for the backward substitution; returns B K^-1 f, m.
  VecX forward(const VecX& f);
  /// K^-1 (f - B^T lambda) for the last f of forward().
  VecX backward(const VecX& lambda) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
  MatX compliance_;
  VecX forward_;  // L^-1 f, in the factor's order
};

}  // namespace mortise
