// The plane of a model, and how deep it is out of that plane.
#pragma once

#include <numbers>

#include "model/choices.hpp"

namespace mortise {

struct Model {
  Plane plane = Plane::strain;
  double thickness = 1;  ///< length; of a plane model

  bool axisymmetric() const { return plane == Plane::axisymmetric; }

  /// The factor of an area of the mesh, or of a length of its curves, where the first coordinate is x1, length:
  /// the thickness, or the circumference of the ring.
  double depth(double x1) const { return axisymmetric() ? 2 * std::numbers::pi * x1 : thickness; }

  bool operator==(const Model&) const = default;
};

}  // namespace mortise
