// The figures that say how far a result can be trusted.
#pragma once

#include "app/solve_scene.hpp"

namespace mortise {

/// Fills results.checks, and status if one fails. `lambda` holds the stacked row values, `coupling` their rows.
void add_checks(const SaddlePointSolution& solution, const StackedCoupling& coupling, const Scene& scene,
                Results& results);

/// A pressure that matters to no body, stress: 1e-3 of the largest stress in any, or what round-off of the
/// displacements makes of a contact that carries none. It does not change where bodies are moved as a whole.
double negligible_pressure(const Results& results);

}  // namespace mortise
