/// From a scene to its results: solve_scene, estimate, solve_to_accuracy, check_scene, solve_cases, solve_run,
/// gradients; Results, Status.
#pragma once

#include "app/accuracy.hpp"
#include "app/cases.hpp"
#include "app/gradients.hpp"
#include "app/solve_scene.hpp"
#include "app/sweep.hpp"
#include "solve/threads.hpp"
