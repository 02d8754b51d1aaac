// Where the curvature of a drawn contact curve jumps.
#pragma once

#include <numbers>
#include <vector>

#include "contact/contact_line.hpp"

namespace mortise {

/// A curve that turns by more at a place has a kink there: as of kinks that exponents tell of (singular_points.cpp).
inline constexpr double sharpest_joint = 2 * std::numbers::pi / 180;

/// A place of a drawn curve that goes on smoothly: an arc that joins a line, a knot of a spline.
struct CurvatureJump {
  int edge;
  double xi;    ///< of the edge, -1 or more and less than 1
  double jump;  ///< 1 / length, positive where the line turns more to the left behind it
};

/// Of the vertices and within the edges, in the order of the curve; kinks are none. Empty where only the mesh is known:
/// curvatures of a line rebuilt from nodes jump at every node.
std::vector<CurvatureJump> curvature_jumps(const Points& nodes, const Curve& curve, const ContactLine& line);

}  // namespace mortise
