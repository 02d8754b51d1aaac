// Findings before the solve of what a scene probably does not mean, one line each with its place. What shows
// after it: results/audit_solution.hpp.
#pragma once

#include "problem/contact_pair.hpp"

namespace mortise {

/// Boundaries of different bodies that meet, or lie over one another, where no contact pair stands
/// between them; one line for two bodies.
/// Throws SceneError for what is surely a mistake: elements listed twice, an edge that two loads name, bodies drawn
/// over one another (docs/files.md, notes).
std::vector<std::string> audit(const Mesh& mesh, const std::vector<BoundaryEntry>& entries,
                               const std::vector<ContactPair>& pairs);

}  // namespace mortise
