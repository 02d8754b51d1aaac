// The figures that say whether a result holds.
#pragma once

#include "results/results.hpp"

namespace mortise {

/// The sum of reactions and loads, which the terminal shows for every scene.
inline constexpr const char* balance_check = "reactions and loads sum to zero";

/// Of a run that has all but checks and warnings.
std::vector<Check> checks(const Results& results);

/// solved where the solver converged, all checks hold and all is finite.
Status verdict(const Results& results);

/// A force on a body that its balance does not see, times depth: what round-off makes of stiffness times displacement.
double unseen_force(const Results& results);

/// The results that are not finite, in words; empty if all are.
std::string not_finite(const Results& results);

}  // namespace mortise
