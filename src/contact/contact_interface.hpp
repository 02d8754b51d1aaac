// Two curves that may touch, and what contact makes of them.
#pragma once

#include <algorithm>
#include <span>

#include "contact/contact_geometry.hpp"
#include "contact/coupling_rows.hpp"

namespace mortise {

/// A quadrature point of a contact pair.
struct ContactPoint {
  int edge;  ///< of the multiplier side
  double xi;
  double ds;    ///< weight times length element, length
  double dA;    ///< ds times depth (model/model.hpp)
  Vec2 normal;  ///< unit, out of the multiplier side's body
  int opposite_edge;
  double eta;          ///< reference coordinate on the opposite edge
  double gap;          ///< undeformed, along the normal, length, positive when open
  double unknown = 0;  ///< what the gap may be off by, as the lines are not known any better, length
};

/// Filled from the top: each member by functions of those above it.
struct ContactInterface {
  Curve multiplier, opposite;        ///< the curve that carries the multipliers, and the other
  ContactGeometry geometry;          ///< where normals and gaps come from
  std::vector<ContactPoint> points;  ///< at which contact is integrated (segments.hpp)
  Coupling coupling;                 ///< the rows (coupling.hpp)
};

/// Of the points of an interface those of each edge of the multiplier side, one behind another.
template <typename Points>
auto edge_by_edge(Points& points) {
  std::vector<decltype(std::span(points))> runs;
  for (auto first = points.begin(); first != points.end();) {
    const auto last = std::find_if(first, points.end(), [&](const ContactPoint& p) { return p.edge != first->edge; });
    runs.emplace_back(first, last);
    first = last;
  }
  return runs;
}

}  // namespace mortise
