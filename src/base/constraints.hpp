// Prescribed displacements.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace mortise {

/// Degrees of freedom whose displacement is given. Both have one entry a degree of freedom.
struct Constraints {
  std::vector<char> fixed;
  VecX value;          ///< length; zero where not fixed
  bool rings = false;  ///< rigid motions are along x2 only
};

}  // namespace mortise
