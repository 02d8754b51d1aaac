// One scene from data to results.
#pragma once

#include "results/results.hpp"
#include "scene/scene.hpp"

namespace mortise {

/// Reads or makes the mesh, with the copies in it. `cached`: as of load_mesh. Throws InputError.
Mesh scene_mesh(const Scene& scene, bool* cached = nullptr);

/// Reads or makes the mesh and solves. Throws InputError for bad input, and where nothing holds a body.
/// `start`: the active set to start from, each row from the nearest one; all rows closed where there is none, or it
/// is of other pairs.
Results solve_scene(const Scene& scene, const Progress& progress = {}, const ActiveSet* start = nullptr);

/// The same on a mesh that is already there.
Results solve_scene(const Scene& scene, Mesh mesh, const Progress& progress = {}, const ActiveSet* start = nullptr);

/// The estimated error into the results, and a warning where it is large. `found`: as of estimate_error; `forces`:
/// whether forces and lengths in contact get bars too. Throws SceneError as estimate_error does, and where spec asks
/// for a displacement that nothing holds.
void estimate(Results& results, const AccuracySpec& spec = {}, const std::vector<FoundPoint>& found = {},
              bool forces = true);

/// The inf-sup constant into the results, and a warning where it is small.
void diagnose(Results& results);

ActiveSet active_set(const Results& results);

/// Everything solve_scene would refuse before it factorises, refused. Throws InputError as it does.
Problem check_scene(const Scene& scene);

}  // namespace mortise
