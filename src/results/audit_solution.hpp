// Findings in a solution that the scene probably does not mean.
#pragma once

#include "problem/audited_bodies.hpp"
#include "results/results.hpp"

namespace mortise {

/// The lines below; nothing where the run did not converge. Sets AuditMemory::missed.
std::vector<std::string> audit_solution(const Results& results);

/// A line for each unilateral pair whose contact reaches the end of a curve although the boundary goes on smoothly
/// there and still faces the other body.
std::vector<std::string> end_lines(const AuditedBodies& bodies, const Results& results);

/// Of the drawn bodies those edges and pieces that can make a line below by displacements up to `largest`: what comes
/// near, and no pair stands between them.
std::vector<EdgeAndPiece> may_cross(const AuditedBodies& bodies, double largest);

/// A line for each two bodies that pass through one another in the deformed state where no pair stands between them.
/// `some`: all that may; null: not known. Adds to `missed` the pairs that patterns mean there.
std::vector<std::string> crossing_lines(const AuditedBodies& bodies, const Results& results,
                                        const std::vector<EdgeAndPiece>* some, std::vector<KnownPair>& missed);

/// A line for each pair whose drawn overlap is undone by moving bodies as a whole: it is many times what they deform
/// by.
std::vector<std::string> drawn_overlap_lines(const Results& results);

}  // namespace mortise
