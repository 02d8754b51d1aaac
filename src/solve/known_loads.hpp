// What loads do to bodies without contact, for many loads that are sums of a few.
#pragma once

#include <vector>

#include "solve/split_cholesky.hpp"

namespace mortise {

/// Of a load f, in the words of BorderedCholesky.
struct LoadResponse {
  VecX at_border;  ///< B K^-1 f
  VecX y;          ///< L^-1 f; empty where f is a sum of earlier loads
  VecX u;          ///< K^-1 f; empty where it is neither asked for nor known

  /// K^-1 (f - B^T lambda), n.
  VecX with(SplitCholesky& factor, const VecX& lambda) const;
};

/// Of a load by itself. `with_u`: whether u is asked for.
LoadResponse respond(const SplitCholesky& factor, const VecX& load, bool with_u);

/// Remembers what the loads f that it is asked about do: one that adds up from these (a scaled load, another mixture of
/// the same pressures) costs no substitution, unless the responses are far larger than their sum, whose round-off a
/// solution by itself has not.
class KnownLoads {
 public:
  LoadResponse respond(const SplitCholesky& factor, const VecX& load, bool with_u);

 private:
  struct Known {
    VecX load, y, at_border;  // orthogonal to the loads before, and what that does
    VecX u;                   // empty before it is asked for
  };
  std::vector<double> parts(const SplitCholesky& factor, const VecX& load);
  std::vector<Known> known_;
};

}  // namespace mortise
