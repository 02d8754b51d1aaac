// What the length in contact of a pair may be off by.
#pragma once

#include "error/pressure_estimate.hpp"
#include "problem/problem.hpp"

namespace mortise {

/// Of each border the edge on which contact ends, and by how much the bodies' errors may move it (border_motion).
/// Where bodies part at a small angle, as just before they touch all along, the least change of p moves the border far:
/// edges are undecided that carry no more p than their bars at both ends, and such beyond a border as p's bar there
/// would close. A gap g at a distance l from the border takes E* g / 2 l to close (docs/theory.md eq. 51). Where
/// p falls to a point at which it has no limit, as much of the edge as it needs to reach zero.
/// `estimate`: with its bars; `u`: displacements.
double length_error(const Problem& problem, const ContactPair& pair, const VecX& u, const PressureEstimate& estimate);

}  // namespace mortise
