// Findings before the solve of what a scene probably does not mean, one line each with its place. What shows
// after it: results/audit_solution.hpp.
#pragma once

#include "problem/contact_pair.hpp"
#include "problem/entries.hpp"

namespace mortise {

/// Boundaries of different bodies that meet, or lie over one another, where no contact pair stands
/// between them; one line for two bodies. And bodies that share nodes without a pair, if they are of one material:
/// those of several are drawn so to be one piece. Throws SceneError for what is surely a mistake: elements listed
/// twice, an edge that two loads name, bodies drawn over one another (docs/files.md, notes).
std::vector<std::string> audit(const Mesh& mesh, const Entries& entries, const std::vector<ContactPair>& pairs);

}  // namespace mortise
