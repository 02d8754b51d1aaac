// A problem under other loads.
#pragma once

#include "problem/problem.hpp"

namespace mortise {

/// Gives a problem the loads of a scene that differs in loads alone (scene/loads.hpp) from the one that it was made
/// from: f, g and prescribed values, with the figures and words that belong to them; what springs or rows hold stays.
/// False where a gap changes the rows of contact themselves, which then are another problem's: what is left is no
/// problem. Throws SceneError as prepare().
bool take_loads(const Scene& scene, Problem& problem);

}  // namespace mortise
