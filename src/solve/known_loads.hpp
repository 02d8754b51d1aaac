// How far loads move bodies without contact, for many loads that are sums of a few.
#pragma once

#include <vector>

#include "solve/split_cholesky.hpp"

namespace mortise {

/// Remembers what the loads f that it is asked about do: one that adds up from these (a scaled load, another mixture of
/// the same pressures) costs no substitution. Only for what needs no more than a magnitude: sums of responses have
/// round-off that a solution by itself has not.
class KnownLoads {
 public:
  /// The largest entry of K^-1 f. `rows`: of the border; `y`: L^-1 f (BorderedCholesky).
  double displacement(const SplitCholesky& factor, Eigen::Index rows, const VecX& load, const VecX& y);

 private:
  struct Known {
    VecX load, u;  // orthogonal to the loads before, and what that does
  };
  std::vector<Known> known_;
};

}  // namespace mortise
