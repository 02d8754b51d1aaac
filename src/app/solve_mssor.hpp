// The iterative solver on a scene: options, errors and notes around solve_by_mssor.
#pragma once

#include "app/solve_scene.hpp"

namespace mortise {

/// Solves with all rows closed. Fills results.linear, adds notes and sets the status where the iteration did not
/// converge. Throws InputError where contact opens. A status of the solution other than solved is for require_solved.
SaddlePointSolution solve_mssor(const Scene& scene, const SaddlePointSystem& system, Results& results);

}  // namespace mortise
