// Warnings: places where an answer is poor, and why, though no check fails.
#pragma once

#include "results/large_displacement.hpp"

namespace mortise {

/// One line each, with its place, of a run that has all but warnings. `moved`: its large_displacement.
std::vector<std::string> warnings(const Results& results, const LargeDisplacement& moved);

}  // namespace mortise
