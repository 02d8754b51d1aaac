// Warnings: places where an answer is poor, and why, though no check fails.
#pragma once

#include "results/results.hpp"

namespace mortise {

/// One line each, with its place, of a run that has all but warnings.
std::vector<std::string> warnings(const Results& results);

}  // namespace mortise
