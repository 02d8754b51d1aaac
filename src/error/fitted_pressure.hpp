// p*: the pressure of a pair, closer than its multiplier has it, from the same solve. docs/theory.md, section 14.
#pragma once

#include "error/pressure_estimate.hpp"
#include "problem/problem.hpp"

namespace mortise {

/// Of a pair with linear multipliers between bodies that do not give way on their surface; of others no piece, and none
/// that has fluid on one side alone. p* of a piece is credible if it differs from p_h, at 95 % of the vertices that
/// count, by no more than p_h may miss along the line as the estimate has it, the bodies' errors apart, and is nowhere
/// tension in a unilateral pair. There the line's errors are lowered to those of p*, as every other vertex tells them
/// (48d). `fits`: of the pair. Time as the vertices.
void find_fitted_pressure(const Problem& problem, const ContactPair& pair, PressureFits& fits,
                          PressureEstimate& estimate);

}  // namespace mortise
