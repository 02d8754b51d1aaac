// Mean pressures over windows of a contact line: what is asked of a dual solution.
#pragma once

#include "error/pressure_line.hpp"
#include "error/shared_duals.hpp"

namespace mortise {

/// Half of a window's width, of half the distance between two centres (WindowPlace::reach).
inline constexpr double window_width = 0.6;

/// The mean of p with the weight (1 - z^2)^3, z = -1 ... 1 across the window.
struct PressureWindow {
  double s;           ///< its centre, arc length along the line's edges
  WindowPlace place;  ///< the same on the chord of its edge
  VecX weights;       ///< rows of the pair: the mean is -weights . lambda
  double length = 0;  ///< of what counts of the line, between this window and those next to it, its share
  /// Of one at a border of contact the distance from it at which 1 / sqrt(r) has its mean over the window; else 0.
  double from_border = 0;
};

/// Evenly along the loaded part of the line, 0.6 of their distance wide: three where it is one piece, three more for
/// each further piece up to nine. None where nothing is loaded.
std::vector<PressureWindow> pressure_windows(const ContactPair& pair, const PressureLine& line);

/// With windows of half the width at the ends of a line that is loaded up to them, unless they are left out, and at the
/// borders of contact: there p may be off by more than anywhere within. Where p is a root's over a shorter length than
/// the windows' distance, that at the border is no wider than this allows, and more of them, each three times as far
/// away as the one before, lead from there to the others: what moves the border is large over that length alone.
/// `borders`: LineError::borders.
std::vector<PressureWindow> with_end_windows(const ContactPair& pair, const PressureLine& line,
                                             const std::vector<LineError::Border>& borders,
                                             const std::vector<char>& excluded, std::vector<PressureWindow> windows);

/// How many of these lie between borders and the windows that are even distances apart.
int windows_beside_borders(const PressureLine& line, const std::vector<LineError::Border>& borders);

/// Adds weight times -lambda at a place of the multiplier side, as the rows' values make it, to `weights` (the
/// pair's rows).
void add_pressure_at(const ContactPair& pair, int edge, double xi, double weight, VecX& weights);

}  // namespace mortise
