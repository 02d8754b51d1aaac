// Least squares whose rows have a few neighbouring entries each.
#pragma once

#include "base/types.hpp"

namespace mortise {

/// Rows are turned into a banded triangle as they come, by Givens rotations (Golub & Van Loan 2013, section 5.2): time
/// as the rows times the square of `band`.
class BandedFit {
 public:
  BandedFit(Eigen::Index columns, Eigen::Index band);

  /// A row with entries from column `first` on, at most `band` of them within the columns.
  void add(Eigen::Index first, const VecX& row, double right);

  /// The x of the least sum of squares, or, of those with g . x = value, that of the least one. Empty where rows leave
  /// a part of x open.
  VecX solve() const;
  VecX solve(const VecX& g, double value) const;

 private:
  bool is_regular() const;
  VecX back(VecX right) const;         // R^-1 right
  VecX back_turned(VecX right) const;  // R^-T right

  MatX triangle_;  // columns x band: row k has the entries of R(k, k ... k + band - 1)
  VecX right_;
};

}  // namespace mortise
