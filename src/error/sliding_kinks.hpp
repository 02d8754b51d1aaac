// Kinks of one line in both bodies that turn little, and joints of its curvature: what they do to p hangs on how far
// the bodies slide across them.
#pragma once

#include "error/pressure_estimate.hpp"

namespace mortise {

/// Where bodies slide by s along a line that turns by theta, the gap would open by theta s beyond the kink: closed,
/// that is a dislocation of this height, p = p0 +- E* theta s / (2 pi r), down to a distance r0 = E* theta s / (2 pi
/// p0) where one side opens. Of singular points with a small turn those stay in the list, as points where p has no
/// limit, whose part of p in L2, sqrt(2 r0 / L) with L the loaded length, is more than a third of what is asked (of a
/// mesh of one's own: 0.1 %); the others go. `modulus`: E*. `u`: displacements, n.
void judge_small_kinks(const ContactPair& pair, double modulus, const VecX& u, double asked,
                       PressureEstimate& estimate);

/// Where the curvature of the multiplier side jumps by k the normals turn on beyond, and the gap's slope jumps by k s
/// where bodies slide by s: p = p0 +- A ln r, A = E* k s / 2 pi. If contact reaches such a place and A is more than the
/// mean of p in L2, these normals alone say where contact ends: it is one of those where p has no limit. Else what the
/// line misses of the logarithm is added to the local error, if contact is closed on both sides. `laws`: of the
/// multiplier side's body and the other's.
void add_curvature_jumps(const Points& nodes, const ContactPair& pair, const std::array<ElasticLaw, 2>& laws,
                         const VecX& u, const std::vector<Reach>& reach, PressureEstimate& estimate);

/// Where contact goes on across a kink of the multiplier side that the other has not, its normals turn by theta: what
/// bodies slide by, s, opens the gap on one side of the kink by theta s and closes it on the other, which no motion of
/// the bodies does. p = p0 +- E* theta s / (2 pi r): how far that is more than p, length, is how far from the kink the
/// end of contact is not known. 0 if no such kink is in contact.
double opened_by_kinks(const ContactPair& pair, double modulus, const VecX& u, const PressureEstimate& estimate);

}  // namespace mortise
