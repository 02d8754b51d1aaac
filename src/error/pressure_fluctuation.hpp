// What of the pressure varies within windows, whose means do not see it: as one more functional for a dual solution.
#pragma once

#include <optional>

#include "error/pressure_line.hpp"

namespace mortise {

/// Waves of p that are shorter than windows, and what the bodies' errors do to them: bodies that are too stiff for a
/// wave, as of linear triangles, raise or lower all of it, and no mean over a window tells.
struct PressureFluctuation {
  VecX p;          ///< at each vertex p less what five coefficients tell, stress; 0 where it has no part
  VecX amplitude;  ///< the largest size of that within half of the distance between two windows
  VecX weights;    ///< rows of the pair: int p' p dA / (rms int dA) is -weights . lambda, p' the fluctuation
  double rms;      ///< of p', over what is loaded
  double length;   ///< that is loaded
  double far = 0;  ///< of that mean, stress: what the bodies' errors make it off by

  /// By what part of itself p' is off.
  double part() const { return far / rms; }
};

/// p less the polynomial in s, of each piece of the line that is loaded and not left out, that fits it best in least
/// squares with as many coefficients as windows tell means, five; of a closed line that is loaded all round, less its
/// mean and its two longest waves. `distance`: between two windows. Nothing where p is no more than that.
std::optional<PressureFluctuation> pressure_fluctuation(const ContactPair& pair, const PressureLine& line,
                                                        const std::vector<char>& excluded, double distance);

}  // namespace mortise
