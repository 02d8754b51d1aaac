// The audit's findings on the undeformed bodies.
#pragma once

#include <map>

#include "problem/boundary_entries.hpp"
#include "problem/encounters.hpp"

namespace mortise {

/// A line for two bodies, the one with the smaller index first.
using LineOfBodies = std::map<std::pair<int, int>, std::string>;

/// A line for each two bodies whose boundaries meet where no pair stands between them.
LineOfBodies meeting_lines(const AuditedBodies& bodies, const std::vector<Encounter>& encounters);

/// A line for each two bodies drawn into one another without a pair there.
/// Throws SceneError where one covers more than half of the other, or reaches deeper than a quarter of a thickness
/// without a pair, or in a pair than half of it, from where contact takes the far side (deepest_overlap): no
/// interference that contact could press apart.
LineOfBodies overlap_lines(const AuditedBodies& bodies, const std::vector<Encounter>& encounters);

/// Throws SceneError where two curves with loads have an edge in common.
void refuse_double_loads(const Mesh& mesh, const std::vector<BoundaryEntry>& entries);

}  // namespace mortise
