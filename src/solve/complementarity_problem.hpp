// Unilateral contact in the multipliers alone, as data.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace mortise {

/// lambda <= 0 and w >= 0 and lambda w = 0 on unilateral rows, w = 0 on the others, where w = r - C lambda - H mu is
/// what is left open of each row for the right-hand side (r, h), m + s (docs/theory.md eq. 24 to 26). Any consistent
/// units.
struct ComplementarityProblem {
  MatX compliance;               ///< (m + s) x (m + s), lower triangle, as MultiplierSystem wants it
  VecX scale;                    ///< m: lambda_a / scale_a is what is compared with other rows'
  std::vector<char> unilateral;  ///< m: rows that may open
  /// A w that is smaller is round-off of what it was computed from, and so are lambda that alone make no larger w.
  double round_off = 0;
  /// Of a correction: the multipliers, m, whose work r and h are without, so that lambda is they and what is added; and
  /// the largest displacement, of which w may be round-off. Else empty and 0.
  VecX known = {};
  double displacement = 0;
};

}  // namespace mortise
