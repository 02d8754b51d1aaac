// Two curves that may touch, and what contact makes of them.
#pragma once

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

}  // namespace mortise
