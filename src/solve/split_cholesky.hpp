// The bordered factor of a structure that falls into parts: bodies that only the border joins, halves of large bodies.
#pragma once

#include "solve/row_responses.hpp"

namespace mortise {

/// From so many unknowns on, a factor a body, and two of a body that has so many itself: below, one for all takes less.
inline constexpr int split_from = 100000;

/// As BorderedCholesky, whose words it shares, by substructures (Przemieniecki 1963). From `split_from` unknowns on, K
/// falls into bodies that nothing couples, and a large body into two halves that only the unknowns s of a separator
/// couple. Each part p is ordered, factorised and solved by itself, several at once, with a border E_p of those rows of
/// K_s and B that reach it. What they leave of the separators and the border is
///
///            s [ K_ss   B_s^T ]
///            m [ B_s      0   ]  -  sum over p of E_p K_p^-1 E_p^T  =  [ S  F^T ; F  -D ],   C = D + F S^-1 F^T,
///
/// of which one more BorderedCholesky has the factor of S with the border F, and F S^-1 F^T. Without a separator C is
/// D. Which parts there are, and what comes out, does not depend on the number of threads.
class SplitCholesky {
 public:
  SplitCholesky(SparseMatrix&& matrix, const std::vector<int>& blocks, int from = split_from,
                int dissect = dissect_from);

  int failed_at() const;
  MatX take_border_compliance() { return std::move(compliance_); }

  /// Rows of y.
  Eigen::Index size() const;
  VecX forward(const VecX& f) const;
  VecX at_border(const VecX& y) const;
  MatX backward(const MatX& y, const MatX& lambda) const;
  /// -K^-1 B^T lambda, by what is known of the rows: not the last digits that backward has, whatever was asked before.
  /// Not by several threads at once.
  MatX at_rows(const MatX& lambda);

  /// Unknowns of separators.
  Eigen::Index separators() const { return Eigen::Index(separator_.size()); }

 private:
  struct Part {
    std::vector<int> unknowns;
    std::vector<int> border;  // that reaches it: places among the separators' unknowns and then the rows of B
    Eigen::Index first = 0;   // in y
    std::unique_ptr<BorderedCholesky> factor;
    RowResponses responses = {};
    Eigen::Index size() const { return Eigen::Index(unknowns.size() + border.size()); }
  };
  /// From the lower triangle of [-S . ; -F D] to C.
  void eliminate_separators(const std::vector<int>& blocks);
  /// Calls work(part) for each, several at once.
  template <typename Work>
  void for_each_part(Work work) const;
  /// u of the separators and, below, lambda.
  MatX beside_parts(const MatX& y, const MatX& lambda) const;
  /// Sum over p of E_p K_p^-1 f.
  VecX at_borders(const VecX& y) const;

  std::vector<Part> parts_;
  std::vector<int> separator_;                          // unknowns
  std::unique_ptr<BorderedCholesky> separator_factor_;  // of S; none without
  Eigen::Index unknowns_, rows_;
  MatX compliance_;
};

}  // namespace mortise
