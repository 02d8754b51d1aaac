// What functions of place that the mesh does not resolve add to the estimate.
#pragma once

#include "error/error_estimate.hpp"
#include "model/method.hpp"

namespace mortise {

/// Adds what the entries' misfits do to the windows' means and to the goal (docs/theory.md eq. 51), cell by cell, and
/// to p along the lines what those of gaps do, and of loads and strains nearby; costs nothing where there are none.
/// `spec`: that of the estimate.
void add_data_errors(const Problem& problem, const Solution& solution, const AccuracySpec& spec,
                     ErrorEstimate& estimate);

}  // namespace mortise
