// Whether the displacements are small, as the equations take them to be.
#pragma once

#include "results/results.hpp"

namespace mortise {

/// One line that names the place, where contact has moved so far that its equations, written on the undeformed bodies,
/// may be off by more than 1 %: a side has moved against the other by that part of the line's radius of curvature, slid
/// along it by that part of the length in contact (of each patch by itself), or turned by more than 0.1 (of which the
/// square counts). Else where displacements are more than 2 % of the size of the whole. Each pair counts by its part in
/// the norm of all pressure, and the place is that of the pair that counts most.
std::optional<std::string> large_displacement(const Results& results);

}  // namespace mortise
