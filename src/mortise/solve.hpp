/// From a scene to its results: solve_scene, estimate, solve_to_accuracy, check_scene; Results, Status.
#pragma once

#include "app/accuracy.hpp"
#include "app/solve_scene.hpp"
