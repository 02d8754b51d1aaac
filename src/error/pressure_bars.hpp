// The bars of the pressure of a pair, and what counts for its norms.
#pragma once

#include "error/pressure_estimate.hpp"

namespace mortise {

/// Leaves out of the norm what lies nearer than this part of the loaded length to a point where p has no limit; where
/// the line is loaded on more than two sides of such points, so much less that no more is left out than beside two.
void find_excluded(double part, PressureEstimate& estimate);

/// Sets what each window stands for: by the convexity of squares far2 is no more than the sum of lengths times the
/// squares of what the windows' means are off by.
void find_window_lengths(PressureEstimate& estimate);

/// Sets the bars and the squares of an estimate whose line, local errors and far field are there.
void find_bars(PressureEstimate& estimate);

/// By how much the bodies' errors may move a border of contact, length (docs/theory.md eq. 48e).
double border_motion(const PressureEstimate& estimate, const LineError::Border& border);

}  // namespace mortise
