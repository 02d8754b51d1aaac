// Dual solutions as sums of a few that were solved for.
#pragma once

#include <utility>
#include <vector>

#include "base/types.hpp"

namespace mortise {

/// F duals as sums of fields: of each some z (n x some), how much of it there is in the duals (some x F).
class DualSums {
 public:
  struct Term {
    const MatX& z;
    const MatX& of;
  };
  explicit DualSums(std::vector<Term> terms) : terms_(std::move(terms)) {}

  const std::vector<Term>& terms() const { return terms_; }
  Eigen::Index count() const { return terms_.front().of.cols(); }
  /// n x F.
  MatX fields() const;
  VecX field(Eigen::Index k) const;

 private:
  std::vector<Term> terms_;  // at least one
};

}  // namespace mortise
