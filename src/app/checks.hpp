// The figures that say how far a result can be trusted.
#pragma once

#include "app/solve_scene.hpp"

namespace mortise {

/// Fills results.checks, and status if one fails. `lambda` holds the stacked row values, `coupling` their rows.
void add_checks(const SaddlePointSolution& solution, const StackedCoupling& coupling, const Scene& scene,
                Results& results);

}  // namespace mortise
