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

/// A mesh for several cases.
struct AccurateMesh {
  Mesh mesh;
  AccuracyReport report;          ///< of the case that is farthest from what was asked
  std::vector<FoundPoint> found;  ///< singular points of all cases, on all meshes
  std::vector<char> open;         ///< of each case: nothing is pressed, and that is the answer
};

/// The same for cases of one geometry and one accuracy: on each mesh all are solved (CaseSolver), the next has the
/// sizes that the most demanding of them asks for at each place, and the last is one on which all are within what was
/// asked. Cases that are refused are left out. Throws InputError where all are.
AccurateMesh mesh_to_accuracy(const std::vector<const Scene*>& cases, const Progress& progress = {});

}  // namespace mortise
