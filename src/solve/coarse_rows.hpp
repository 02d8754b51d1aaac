// Neighbouring rows joined in pairs: a smaller problem whose active set is a good guess for the larger one's.
#pragma once

#include "solve/complementarity_problem.hpp"

namespace mortise {

struct CoarseRows {
  std::vector<int> group;  ///< row of the fine problem -> row of this one
  ComplementarityProblem problem;
  VecX rhs;
};

/// Joins rows 0 and 1, 2 and 3, ... where both may open or neither may. A coarse row is the sum of both (before they
/// were divided by their scales): one stress on both, and their weighted gaps together. Rows are expected in their
/// order along the contact curves; joining rows of two curves spoils a guess, no more.
CoarseRows join_rows(const ComplementarityProblem& fine, const VecX& rhs);

}  // namespace mortise
