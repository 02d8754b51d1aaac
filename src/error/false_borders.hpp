// Vertices without p_h within the loaded line, which are no border of contact.
#pragma once

#include <vector>

#include "error/pressure_estimate.hpp"

namespace mortise {

/// PressureEstimate::swings, by its singular points.
std::vector<char> swinging(const PressureEstimate& e);

/// Of an estimate whose swings and singular points are known: p_h may be zero where it swings, and beside a point at
/// which p has no limit.
void forget_false_borders(PressureEstimate& e);

}  // namespace mortise
