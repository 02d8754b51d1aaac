// What a solved scene's meshes say of its pressures, beside the checks of every run.
#pragma once

#include "app/solve_scene.hpp"

namespace mortise {

/// Fills results.inf_sup for the closed rows, and adds a note where it is below `inf_sup_limit`. Costs another
/// factorisation and the eigenvalues of a dense matrix of the multipliers' size.
void diagnose(const Scene& scene, Results& results);

/// Below this the pressures are not to be trusted: docs/stability.md shows what happens there.
inline constexpr double inf_sup_limit = 0.1;

}  // namespace mortise
