// Functions of place that the mesh does not resolve, in bars and warnings.
#pragma once

#include "results/results.hpp"
#include "scene/scene.hpp"

namespace mortise {

/// After estimate(): adds to the estimate and to the bars what functions of the scene do within elements
/// (error/data_estimate.hpp), and, on a mesh of the user's own, a warning for each entry that varies by more than a
/// hundredth of its size there. Costs nothing where no function varies. `spec`: that of the estimate.
void add_data_errors(const Scene& scene, Results& results, const AccuracySpec& spec = {});

}  // namespace mortise
