// The bars of the pressure of a pair, and what counts for its norms.
#pragma once

#include "error/pressure_estimate.hpp"

namespace mortise {

/// Leaves out of the norm what lies nearer than this part of a loaded piece's length to a point of it where p has no
/// limit; if it is loaded on more than two sides of such points, so much less that no more is left out than beside two;
/// nothing of a piece of which nothing else would be left. A contact with such a point whose force (a depth) is less
/// than `negligible` is left out as a whole.
void find_excluded(double part, double negligible, PressureEstimate& estimate);

/// The force (a depth) that is not seen in p of all pairs: a third of the part that is asked. On a tenth of the loaded
/// length it is about what is asked of p's norm; a point may have it, and has no p in L2.
double negligible_force(const std::vector<PressureEstimate>& pressures, const AccuracySpec& spec);

/// Sets what each window stands for: by the convexity of squares far2 is no more than the sum of lengths times the
/// squares of what the windows' means are off by.
void find_window_lengths(PressureEstimate& estimate);

/// Sets the bars and the squares of an estimate whose line, local errors and far field are there.
void find_bars(PressureEstimate& estimate);

/// By how much the bodies' errors may move a border of contact, length (docs/theory.md eq. 48e).
double border_motion(const PressureEstimate& estimate, const LineError::Border& border);

}  // namespace mortise
