// The pressure to an asked accuracy: meshes and solves until the bars say so.
#pragma once

#include "app/solve_scene.hpp"

namespace mortise {

/// Solves on finer and finer free meshes until the estimated error of p is at most scene.accuracy->value
/// (docs/accuracy.md); at most most_solves times and up to unknowns_max. Results of the last complete solve, with
/// Results::accuracy; not_converged where the accuracy was not reached. `interrupted`: asked between the stages; where
/// it says true the last complete answer is returned, or std::nullopt if there is none.
std::optional<Results> solve_to_accuracy(const Scene& scene, const Progress& progress = {},
                                         const std::function<bool()>& interrupted = {});

inline constexpr int most_solves = 8;

}  // namespace mortise
