// What forces on the border's rows do to the unknowns, for many of them one after another.
#pragma once

#include <vector>

#include "solve/bordered_cholesky.hpp"

namespace mortise {

/// Columns of K^-1 B^T, kept as soon as they have cost no more than the substitutions before: of few rows their product
/// with lambda takes less than a substitution, which reads the whole factor. However often and of whatever rows it is
/// asked, it takes no more than twice the less of both.
class RowResponses {
 public:
  /// -K^-1 B^T lambda, n x count, of `factor`, always the same.
  MatX at(const BorderedCholesky& factor, const MatX& lambda);
  /// How many columns are kept.
  Eigen::Index known() const { return used_; }

 private:
  bool know(const BorderedCholesky& factor, const std::vector<int>& rows, Eigen::Index rows_in_all);

  std::vector<int> place_;  // of each row among the columns; -1: none
  MatX columns_;            // those in use first
  Eigen::Index used_ = 0, substituted_ = 0;
};

}  // namespace mortise
