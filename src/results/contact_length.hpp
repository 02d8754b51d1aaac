// How much of a curve is in contact.
#pragma once

#include <array>
#include <optional>

#include "problem/contact_pair.hpp"

namespace mortise {

struct ContactLength {
  double length = 0;
  /// Arc lengths, along the edges as they run, at which contact begins and ends; it may have gaps between them. None of
  /// a closed curve, or without contact.
  std::optional<std::array<double, 2>> ends = {};
};

/// Whether contact ends where the sides no longer overlap.
inline bool gives_way(const ContactPair& pair) { return pair.spec.stiffness && !pair.spec.fluid; }

/// Length of the multiplier side that faces the opposite side and carries pressure; of bilateral pairs, that faces it.
/// Where contact ends within an edge, p falls like the root of the distance to its end (Johnson 1985, section 4.2): the
/// end lies where the line through the last three vertices' p^2 is zero. On Hertz' problem within 0.3 of an edge.
/// `pressure`: one a multiplier, stress; `fluid`: what of it a fluid's is (of dry ones 0); none is carried where it is
/// no more than `round_off`.
ContactLength length_in_contact(const Points& nodes, const ContactPair& pair, const VecX& pressure, const VecX& fluid,
                                double round_off);

/// Of a pair that gives way, so that p falls as its law says: contact ends where what the sides overlap, `overlap`, one
/// a multiplier, < 0 where they are apart, is zero on the way between two vertices.
ContactLength length_of_overlap(const Points& nodes, const ContactPair& pair, const VecX& overlap, double round_off);

}  // namespace mortise
