// What a user should know that no check fails for.
#pragma once

#include "app/solve_scene.hpp"

namespace mortise {

/// Fills results.notes. `unsettled`: rows of the stacked coupling that the active set would still change.
void add_notes(const Scene& scene, const std::vector<int>& unsettled, Results& results);

}  // namespace mortise
