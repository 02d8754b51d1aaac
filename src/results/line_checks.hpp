// Checks of contact lines: that they are what the equations take them to be.
#pragma once

#include <optional>

#include "results/results.hpp"

namespace mortise {

/// The part of a closed pair's shorter curve that segments miss, or take twice; with the place.
Check coverage_check(const Results& results);

/// Contact is written on the undeformed bodies: the force of a line that turns by an angle is off by about that part,
/// and so is p where the sides move by that part of the length in contact or of the radius of curvature, or where edges
/// turn (by the square) and stretch (LineMotion). The value is the part of p that all pairs together lose so, in the
/// norm of all contact lines, of each pair at most all of its own; from a half on, the answer is that of another
/// problem.
Check motion_check(const Results& results);

/// Of a run with an estimate: by what part p is off in the norm of all contact lines; from a half on there is no figure
/// left to trust. Infinite where contact carries p on too few edges to say. Nothing where nothing is loaded.
std::optional<Check> estimate_check(const Results& results);

}  // namespace mortise
