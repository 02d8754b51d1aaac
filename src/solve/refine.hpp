// A linear system solved by an inverse that is about right.
#pragma once

#include <limits>

#include "base/types.hpp"

namespace mortise {

/// x of A x = rhs: what `solve` (rhs to about x) leaves by `multiply` (x to A x) is solved for again, as long as that
/// lowers the largest entry of what is left, over `unit`; ten times at most.
template <typename Solve, typename Multiply>
VecX refined(const VecX& rhs, const VecX& unit, const Solve& solve, const Multiply& multiply) {
  constexpr int most_passes = 10;  // to 1e-10, where a tenth is left each time
  VecX x = VecX::Zero(rhs.size()), left = rhs;
  double least = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < most_passes; ++pass) {
    const VecX next = x + solve(left), now = rhs - multiply(next);
    const double size = largest_entry(now.cwiseQuotient(unit));
    if (!(size < least)) break;
    least = size;
    x = next;
    left = now;
  }
  return x;
}

}  // namespace mortise
