// Contact that the mesh is too coarse to notice.
#pragma once

#include "error/pressure_estimate.hpp"
#include "problem/problem.hpp"

namespace mortise {

/// A row of the multipliers holds the gap open in the mean of its edges. Where these are longer than a contact would
/// be, round bodies pass through one another between their nodes, and p is 0. Sets LineError::missed, on edges that are
/// away from those of contact, the pressure that would part the bodies: curves that overlap by d over a width 2 a make
/// as cylinders p0 = E* d / a (Johnson 1985, eq. 4.45: d = a^2 / 2 R, p0 = E* a / 2 R), sqrt(4 a / 3) p0 in L2,
/// of contact that gives way no more than its law has at d; and marks these vertices as loaded. Bodies that no pressure
/// holds are moved apart first as far as they can be. `of_overlaps`: what overlaps at borders of contact do to the
/// displacements u; contact counts as missed that is there with or without it. `list`: one a pair, with its line and
/// the line's own error.
void add_missed_contact(const Problem& problem, const VecX& u, const VecX& of_overlaps,
                        std::vector<PressureEstimate>& list);

}  // namespace mortise
