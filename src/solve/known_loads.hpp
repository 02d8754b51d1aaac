// How far loads move bodies without contact, for many loads that are sums of a few.
#pragma once

#include <vector>

#include "solve/split_cholesky.hpp"

namespace mortise {

/// Remembers what the loads f that it is asked about do.
class KnownLoads {
 public:
  /// L^-1 f (BorderedCholesky); of a multiple of the load before without a substitution.
  VecX forward(const SplitCholesky& factor, const VecX& load);

  /// The largest entry of K^-1 f; of a load that adds up from those before (another mixture of the same pressures)
  /// without a substitution. No more than a magnitude: sums of responses have round-off that a solution by itself has
  /// not. `rows`: of the border; `y`: L^-1 f.
  double displacement(const SplitCholesky& factor, Eigen::Index rows, const VecX& load, const VecX& y);

 private:
  struct Known {
    VecX load, u;  // orthogonal to the loads before, and what that does
  };
  std::vector<Known> known_;
  struct {
    VecX load, y;
  } last_;
};

}  // namespace mortise
