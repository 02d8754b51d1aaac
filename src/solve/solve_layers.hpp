// Surface layers whose laws are not linear.
#pragma once

#include <functional>

#include "solve/saddle_point_system.hpp"

namespace mortise {

/// Newton's method on the energy of bodies and layers, which is convex, under B u + B_d d >= g: `solve` finds the least
/// of it with layers of tangents, and the next iterate lies as far on the way there as the energy itself falls for
/// sure. So it falls in each step, from wherever it starts, and near the solution the steps are Newton's (Li,
/// Fukushima, Qi & Yamashita 2004; docs/theory.md section 5). The first system has the slope of each law at its largest
/// given overlap, the second that where the law has the first one's pressures.
///
/// Deviation: tangents are taken at overlaps no less than the last step changed any, where Li et al. add the norm of
/// the gradient: laws may have no slope at 0, and open contact is there.
///
/// converged: what layers press with is the law's to 1e-8 of the largest.
Solution solve_layers(const SaddlePointSystem& system, const std::function<Solution(SaddlePointSystem)>& solve);

}  // namespace mortise
