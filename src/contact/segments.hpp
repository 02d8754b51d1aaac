// Segments of the multiplier side, and the points at which contact is integrated.
#pragma once

#include <optional>
#include <vector>

#include "contact/contact_interface.hpp"
#include "model/choices.hpp"

namespace mortise {

/// A piece of an edge of the multiplier side that faces one edge of the opposite side: both sides' shape functions
/// are smooth on it.
struct Segment {
  int edge;           ///< of the multiplier side
  double begin, end;  ///< reference coordinates on that edge, begin < end
  int opposite_edge;
};

/// Cuts the multiplier side at the opposite side's vertices, projected along the multiplier side's normals.
/// Pieces that face nothing are left out (partial overlap).
std::vector<Segment> find_segments(const Points& nodes, const ContactInterface& interface);

/// At a corner of either side the gap may step up, or rise at once: beyond an overhang, around the tip of a tooth. A
/// row over the corner holds the mean of both sides, and would stay open up to an edge before it, so that the corner
/// digs in. So contact ends there as at an end of the opposite side: of `segments`, in the order of the curve, those on
/// the far side are left out on the edges whose multipliers have a part of them on the near side. What strains and
/// turns of small displacements may close within an edge is no step, nor are steps of a gap that is given.
std::vector<Segment> up_to_steps(const Points& nodes, const ContactInterface& interface, std::vector<Segment> segments);

/// Gauss points on each segment: exact on straight edges for the product of both sides' shape functions, and of a
/// multiplier's and a gap that is quadratic; of rings with their radius.
/// Integration::elements takes the same rule on whole edges without cutting; points that face nothing are left out.
std::vector<ContactPoint> contact_points(const Points& nodes, const ContactInterface& interface,
                                         Integration integration);

/// The point at xi on an edge of the multiplier side, without weight; `opposite_edge`: asked first. Nothing where it
/// faces nothing.
std::optional<ContactPoint> contact_point(const Points& nodes, const ContactInterface& interface, int edge, double xi,
                                          int opposite_edge = -1);

/// The part of a curve's length that faces the other curve, 0 ... 1, asked at two points an edge.
double covered_part(const Points& nodes, const Curve& curve, const Curve& opposite);

}  // namespace mortise
