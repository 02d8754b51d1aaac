// Where the drawn gap of a pair jumps: the opposite side ends, and the normals meet it again farther away.
#pragma once

#include "contact/segments.hpp"

namespace mortise {

/// At a corner of the opposite side beyond which that faces the multiplier side again, the gap is a function with a
/// step. A row over the step holds the mean of both sides, and would stay open up to an edge before the corner, which
/// digs in. So contact ends there as at an end of the opposite side: of `segments`, in the order of the curve, those on
/// the far side are left out on the edges whose multipliers have a part of them on the near side. Steps that strains of
/// small displacements may close within an edge are none, nor are those of a gap that is given.
std::vector<Segment> up_to_steps(const Points& nodes, const ContactInterface& interface, std::vector<Segment> segments);

}  // namespace mortise
