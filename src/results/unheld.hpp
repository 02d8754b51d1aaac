// Displacements that are not an answer: of bodies that nothing holds.
#pragma once

#include "results/results.hpp"

namespace mortise {

/// Of x and y, whether a motion that nothing holds (Results::unheld) moves a place of a body along it: then the
/// displacement there is any, and what stands in the results is one of them.
std::array<bool, 2> unheld_at(const Results& results, int body, const Vec2& x);

/// Whether no such motion changes the gap of a pair where that is least: then it is an answer.
bool is_gap_held(const Results& results, const ContactPair& pair);

/// One line a probe whose displacements are such.
std::vector<std::string> unheld_probes(const Results& results);

/// Throws SceneError where a displacement that an accuracy is asked of is such.
void require_held(const Results& results, const AccuracySpec& spec);

/// Takes the bars of such displacements away from the probes.
void leave_out_unheld(Results& results);

}  // namespace mortise
