// Limits on a .geo, which is a program.
#pragma once

namespace mortise {

struct GeoLimits {
  double seconds = 600;  ///< after which the run ends
  bool programs = true;  ///< whether it may run other programs and write files

  bool operator==(const GeoLimits&) const = default;
};

}  // namespace mortise
