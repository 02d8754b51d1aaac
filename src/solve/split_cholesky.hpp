// The bordered factor of bodies that only the border joins: a factor each, on a thread each.
#pragma once

#include "solve/bordered_cholesky.hpp"

namespace mortise {

/// From so many unknowns on, a factor a part: below, one for all takes less.
inline constexpr int split_from = 100000;

/// As BorderedCholesky, whose words it shares. K falls into parts that nothing couples (bodies), K = diag(K_p), so that
/// C = sum of B_p K_p^-1 B_p^T: from `split_from` unknowns on each part is ordered, factorised and solved by itself,
/// several at once; below, all are one. What comes out does not depend on the number of threads.
class SplitCholesky {
 public:
  SplitCholesky(SparseMatrix&& matrix, const std::vector<int>& blocks, int from = split_from);

  int failed_at() const;
  MatX take_border_compliance() { return std::move(compliance_); }

  /// Rows of y.
  Eigen::Index size() const;
  VecX forward(const VecX& f) const;
  VecX at_border(const VecX& y) const;
  MatX backward(const MatX& y, const MatX& lambda) const;

 private:
  struct Part {
    std::vector<int> unknowns, rows;  // of K and of the border, ascending
    Eigen::Index first = 0;           // in y
    std::unique_ptr<BorderedCholesky> factor;
    Eigen::Index size() const { return Eigen::Index(unknowns.size() + rows.size()); }
  };
  /// Calls work(part) for each, several at once.
  template <typename Work>
  void for_each_part(Work work) const;

  std::vector<Part> parts_;
  Eigen::Index unknowns_, rows_;
  MatX compliance_;
};

}  // namespace mortise
