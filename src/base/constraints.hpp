// Prescribed displacements, multi-point constraints, and springs to the ground.
#pragma once

#include <optional>
#include <vector>

#include "base/types.hpp"

namespace mortise {

/// Multi-point constraints u = T q by transformation (Cook, Malkus, Plesha & Witt 2002, section 13.2), T square and
/// invertible: of the q some are prescribed, the others are independent.
struct MultipointConstraints {
  SparseRows T, inverse;      ///< n x n
  std::vector<char> coupled;  ///< n: unknowns of u that are not the q of their own number
  std::vector<char> tied;     ///< n: q that ties prescribe: 0, or what their overlap makes of them
};

/// Degrees of freedom whose displacement is given. Both have one entry a degree of freedom; with multi-point
/// constraints they are those of q.
struct Constraints {
  std::vector<char> fixed;
  VecX value;          ///< length; zero where not fixed
  bool rings = false;  ///< rigid motions are along x2 only
  /// What springs in the stiffness resist: a motion u with springs * u = 0 they do not. A column a degree of freedom;
  /// empty: there are none.
  SparseMatrix springs = {};
  VecX spring_parts = {};  ///< of each of their rows: the springs' stiffness over the elements' there
  std::optional<MultipointConstraints> multipoint = {};  ///< none: q is u
};

}  // namespace mortise
