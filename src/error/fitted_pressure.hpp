// p*: the pressure of a pair, closer than its multiplier has it, from the same solve. docs/theory.md, section 14.
#pragma once

#include "error/pressure_estimate.hpp"
#include "problem/problem.hpp"

namespace mortise {

/// What p* is off by in L2 at the vertices beside a border, over what p_h may be there (47), at most: beside it bodies
/// are half planes and p a root, so that this is a figure of the edges alone. Of 2700 borders on meshes drawn at random
/// two have up to 0.52, the mean is 0.17 (tests/error/border_left_test.cpp).
inline constexpr double border_left = 0.5;

/// Of a pair with linear multipliers between bodies that do not give way on their surface; of others no piece, and none
/// that has fluid on one side alone. p* of a piece is credible if it differs from p_h, at 95 % of the vertices that
/// count, by no more than p_h may miss along the line as the estimate has it, the bodies' errors apart, and is nowhere
/// tension in a unilateral pair. There the line's errors are lowered to those of p*, as coarser meshes tell them (48d),
/// and where contact ends to `border_left`. Time as the vertices.
void find_fitted_pressure(const Problem& problem, const ContactPair& pair, PressureEstimate& estimate);

}  // namespace mortise
