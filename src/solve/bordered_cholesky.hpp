// One sparse Cholesky factorisation from which a saddle-point system is solved exactly.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "solve/block_order.hpp"

namespace mortise {

/// The beta of the bordered matrix: far above anything that a border of unit size leaves of it.
inline constexpr double border_beta = 1e20;

/// The n unknowns of K, in the order in which they are eliminated.
struct EliminationOrder {
  std::vector<int> unknowns;
};

/// Cholesky factor L of a positive definite K, with C = B K^-1 B^T as a by-product (docs/theory.md eq. 15 to 17).
///
///                  n       m                        n    m
///            n [   K      B^T    ]            n [   L    .   ]
///   CHOLMOD:                       =  F F^T,                    =  F        V = L^-1 B^T,   C = V^T V
///            m [   B    beta I   ]            m [  V^T   R   ]
///
/// The border is ordered last, and beta is too large to matter: its rows of the factor are V^T whatever beta is. So C
/// costs one dense product, and a solve with any multipliers one forward and one backward substitution.
/// Deviation from the textbook range-space method (Benzi, Golub & Liesen 2005, section 5), which takes one
/// back-substitution a multiplier to form C.
class BorderedCholesky {
 public:
  /// `matrix` is the upper triangle of [K B^T; B beta I] (which spares CHOLMOD a transposition): n columns of K, then
  /// the columns of B^T with border_beta below them. K and the rows of B are of about unit size. It is taken, and
  /// freed once factorised.
  /// `blocks` groups the n unknowns that share a node (ascending, 0, 0, 1, 1, 2, ...), for block_order.
  BorderedCholesky(SparseMatrix&& matrix, const std::vector<int>& blocks);
  BorderedCholesky(SparseMatrix&& matrix, EliminationOrder order);
  ~BorderedCholesky();

  /// -1, or the unknown at which K turned out not to be positive definite: nothing below may be called then.
  int failed_at() const;

  /// C = B K^-1 B^T, m x m, lower triangle. It is given away: the factor does not need it.
  MatX take_border_compliance() { return std::move(compliance_); }

  /// n, n + m, and how many entries L has.
  int unknowns() const;
  Eigen::Index size() const;
  Eigen::Index entries() const;

  /// These three column by column. y = L^-1 f for f, n; in an order of its own, for the next two.
  MatX forward(const MatX& f) const;
  /// V^T y = B K^-1 f, m.
  MatX at_border(const MatX& y) const;
  /// L^-T (y - V lambda) = K^-1 (f - B^T lambda), n.
  MatX backward(MatX y, const MatX& lambda) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
  MatX compliance_;
};

}  // namespace mortise
