// Whether the displacements are small, as the equations take them to be.
#pragma once

#include "results/results.hpp"

namespace mortise {

struct LargeDisplacement {
  double lost = 0;                  ///< what p of all pairs may be off by in L2, a part of it
  std::optional<std::string> line;  ///< nothing where they are small enough
};

/// The line names the place, where contact has moved so far that its equations, written on the undeformed bodies,
/// may be off by more than 1 %, or by more than the accuracy that is asked for: p along the other side's normals is
/// another by that part in L2 (other_normals.hpp), or the contact line has slid, moved against its curvature, turned or
/// stretched by so much (line_motion.hpp). Else where displacements are more than 2 % of the size of the whole. Each
/// pair counts by its part in the norm of all pressure, and the place is that of the pair that counts most.
LargeDisplacement large_displacement(const Results& results);

}  // namespace mortise
