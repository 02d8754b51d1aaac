// Whether the results are what the scene expects them to be.
#pragma once

#include "results/results.hpp"

namespace mortise {

/// Compares the results with the scene's [[expect]] entries: sets `results.expected`, adds a check for each, and sets
/// the status. Of a run that is complete but for this.
void judge_expectations(Results& results);

}  // namespace mortise
