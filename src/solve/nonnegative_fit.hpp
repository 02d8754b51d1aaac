// Least squares with unknowns that may not be negative.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace mortise {

struct NonnegativeFit {
  VecX x;         ///< m
  VecX residual;  ///< n: b - A x
};

/// min |A x - b|, x >= 0 but for `free` entries (m): Lawson & Hanson, "Solving least squares problems" (1974), chapter
/// 23. A: n x m, with n of the order of a hundred. The residual is zero, or by Farkas' lemma a proof that no such x has
/// A x = b: A^T residual <= 0 (= 0 on free entries), and b^T residual > 0. Each of both holds to round-off.
NonnegativeFit fit_nonnegative(const MatX& A, const VecX& b, const std::vector<char>& free);

}  // namespace mortise
