// What a .geo, which is a program, may do.
#pragma once

namespace mortise {

struct GeoLimits {
  double seconds = 600;  ///< after which the run ends
  bool programs = true;  ///< whether it may run other programs and write files
};

}  // namespace mortise
