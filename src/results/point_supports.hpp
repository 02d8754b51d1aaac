// What a support at a point makes of p as the mesh is refined.
#pragma once

#include <vector>

#include "results/results.hpp"

namespace mortise {

/// Of each of Entries::boundaries: the part of all p by which it changes as elements at the entry's points, if these
/// are held or on springs, become a tenth as long. A force at a point of a boundary sinks in by 2 F / (pi E) ln(1 / h)
/// (Flamant), without bound, which takes load from a support that shares it with others: K du + B^T dl = 0, B du = 0 on
/// closed rows, the point moved by 2 ln 10 F / (pi E). 0 where equilibrium alone gives the force, and of all where the
/// solver has no factor.
std::vector<double> changes_by_point_supports(const Results& results);

}  // namespace mortise
