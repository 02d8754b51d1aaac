// The pressure to an asked accuracy: meshes and solves until the bars say so.
#pragma once

#include "app/solve_scene.hpp"

namespace mortise {

/// Solves on finer and finer free meshes until the estimated error of p is at most scene.accuracy->value
/// (docs/accuracy.md); at most solves_max times and up to unknowns_max. Results of the last complete solve, with
/// Results::accuracy; accuracy_not_reached where nothing worse is to be said of it. `interrupted`: asked between the
/// stages; where it says true the last complete answer is returned, or std::nullopt if there is none.
std::optional<Results> solve_to_accuracy(const Scene& scene, const Progress& progress = {},
                                         const std::function<bool()>& interrupted = {});

}  // namespace mortise
