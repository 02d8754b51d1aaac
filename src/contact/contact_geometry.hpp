// Where a contact pair takes its normals and its undeformed gap from: the curves that its meshes stand for, or their
// edges; and the model whose depth its lengths have.
#pragma once

#include "base/model.hpp"
#include "contact/contact_line.hpp"
#include "contact/projection.hpp"

namespace mortise {

/// A place on a curve: an edge and its reference coordinate.
struct Place {
  int edge;
  double xi;
};

struct ContactGeometry {
  std::optional<ContactLine> multiplier, opposite;  ///< the lines of both sides; only a pair of edges has none
  bool normals = false, gap = false;                ///< whether these are the lines', else the edges'
  double clearance = 0;  ///< added to every gap, length: a clearance (+) or an interference (-) that is not drawn
  Model model = {};

  /// From a place on the multiplier side's edges along the normal there.
  Line line_from(const Points& nodes, const Curve& curve, const Place& at) const;

  /// Undeformed, along a line from a place of the multiplier side that hits the opposite side; length, positive when
  /// open.
  double initial_gap(const Line& line, const Place& at, const Hit& hit) const;
};

}  // namespace mortise
