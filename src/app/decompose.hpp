// Domain decomposition of a scene: options, errors and notes around solve_by_ddm.
#pragma once

#include "app/solve_scene.hpp"
#include "ddm/solve_ddm.hpp"

namespace mortise {

/// Solves by domain decomposition; `dirichlet`: of each body (dirichlet_bodies). Fills results.interface, adds notes
/// and sets the status where the iteration did not converge. Throws InputError where the scene has no such solution,
/// but for a stiffness that is not positive definite, which the solution's status says (require_solved).
SaddlePointSolution decompose(const Scene& scene, const SaddlePointSystem& system, const std::vector<char>& dirichlet,
                              Results& results);

}  // namespace mortise
