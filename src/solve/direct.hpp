// The direct solver: one factorisation of all bodies, and the active set on the multipliers alone.
#pragma once

#include "solve/complementarity_problem.hpp"
#include "solve/contact_factor.hpp"
#include "solve/known_loads.hpp"

namespace mortise {

/// One factorisation for any loads: docs/theory.md, sections 6 and 10.
class DirectSolver {
 public:
  /// Keeps a reference. K, B, the scales, what is fixed, grounded and unilateral stay as they are; f, g, the prescribed
  /// values and the rows to start from may change between solves.
  explicit DirectSolver(const SaddlePointSystem& system);

  /// As a rule to round-off; one step of refinement where that is not reached.
  Solution solve();

 private:
  const SaddlePointSystem& system_;
  std::shared_ptr<FactoredBodies> bodies_;
  ComplementarityProblem problem_;
  KnownLoads loads_;
  std::shared_ptr<const DirectFactor> factor_;  // of the last solution
  std::vector<char> closed_;                    // and its closed rows
  int failed_at_ = -1;
  double factorise_seconds_ = 0;  // that no solution has told
};

Solution solve_directly(const SaddlePointSystem& system);

}  // namespace mortise
