// What of a scene acts on its bodies, apart from what the bodies are and how they are held.
#pragma once

#include "scene/scene.hpp"

namespace mortise {

/// Whether two scenes have the same bodies, mesh, kinds of support and load at the same places, and contact pairs, so
/// that they differ at most in loads, prescribed values, temperatures and initial strains, thermal expansion, density,
/// gravity, pressures of fluids, expectations and, where no tie is locked, gaps, clearances, pretensions and overlaps.
bool differ_in_loads_alone(const Scene& one, const Scene& other);

/// The scene with its loads times the factor: forces, pressures (of fluids, too), tractions, prescribed displacements
/// and turns, gravity, body forces, temperatures and initial strains; gaps, clearances, pretensions and overlaps stay.
Scene scaled_loads(Scene scene, double factor);

}  // namespace mortise
