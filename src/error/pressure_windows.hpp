// Mean pressures over windows of a contact line: what is asked of a dual solution.
#pragma once

#include "error/pressure_line.hpp"

namespace mortise {

/// The mean of p with the weight (1 - z^2)^3, z = -1 ... 1 across the window.
struct PressureWindow {
  double s;      ///< its centre, arc length along the line's edges
  Vec2 centre;   ///< on the chord of its edge
  VecX weights;  ///< rows of the pair: the mean is -weights . lambda
};

/// Evenly along the loaded part of the line, 0.6 of their distance wide: three where it is one piece, three more for
/// each further piece up to nine. None where nothing is loaded.
std::vector<PressureWindow> pressure_windows(const ContactPair& pair, const PressureLine& line);

/// Of the pair's rows, one column: the mean of p between two arc lengths (as in contact.csv) of the multiplier side is
/// minus it times lambda. Zero where the line does not face the other side there.
VecX mean_functional(const Mesh& mesh, const ContactPair& pair, const PressureLine& line, const Vec2& window);

/// Of the pair's rows, two columns: the components of the force on the multiplier side's body are minus them times
/// lambda.
MatX force_functionals(const ContactPair& pair);

}  // namespace mortise
