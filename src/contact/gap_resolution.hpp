// How well the gap between two lines is known, and where both are one.
#pragma once

#include "contact/segments.hpp"

namespace mortise {

/// Sets geometry.one_line of an interface that has its points: where both lines may be one (docs/theory.md section 9).
/// They are, along an edge of the multiplier side, if all gaps between them there are below what both are known to
/// (ContactLine::uncertainty) and 1e-9 of its length, which is a strain of 1e-9; and, where one of them is rebuilt from
/// nodes, if the gap goes from side to side as often as the edges change, by no more than two meshes of one curve show:
/// no pressure on these edges could follow a gap that did. Where they are one `points` keep the clearance alone, and
/// what they lose is `unknown` where they may be apart as well; elsewhere `unknown` is what both lines are known to.
/// Nothing where the gap is not that of the lines.
void find_one_line(const Points& nodes, ContactInterface& interface);

}  // namespace mortise
