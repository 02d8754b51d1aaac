// FreeFEM's answer in the place of mortise's, so that both have their errors from the same code.
#pragma once

#include <string>

#include "results/results.hpp"

namespace mortise::chart {

/// Puts the displacements and contact pressures of a folder (freefem_*.txt, verification/crosscheck/run.py) into the
/// results of a run on the same straight-sided triangles with the same multipliers.
/// Throws std::runtime_error where a node has no partner.
void take_freefem(Results& results, const std::string& folder);

}  // namespace mortise::chart
