// Mean pressures over windows of a contact line: what is asked of a dual solution.
#pragma once

#include "error/pressure_line.hpp"

namespace mortise {

/// The mean of p with the weight (1 - z^2)^3, z = -1 ... 1 across the window.
struct PressureWindow {
  double s;      ///< its centre, arc length along the multiplier side
  double mean;   ///< stress
  VecX weights;  ///< rows of all pairs: mean = -weights . lambda
};

/// Evenly along the loaded part of the line, each a fifth of it long: three where it is one piece, three more for each
/// further piece up to nine. None where nothing is loaded.
std::vector<PressureWindow> pressure_windows(const ContactPair& pair, const PressureLine& line, const VecX& lambda);

}  // namespace mortise
