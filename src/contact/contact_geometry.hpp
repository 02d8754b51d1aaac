// The source of a contact pair's normals and undeformed gap: the curves that its meshes stand for, or their
// edges; and the model whose depth its lengths have.
#pragma once

#include "contact/contact_line.hpp"
#include "contact/projection.hpp"
#include "fem/arc_length.hpp"
#include "model/field.hpp"
#include "model/model.hpp"

namespace mortise {

/// A place on a curve: an edge and its reference coordinate.
struct Place {
  int edge;
  double xi;
};

struct ContactGeometry {
  std::optional<ContactLine> multiplier, opposite;  ///< the lines of both sides; only a pair of edges has none
  bool normals = false, gap = false;                ///< whether these are the lines', else the edges'
  std::optional<Field> given;                       ///< the gap itself, length: whatever the lines and edges
  Field clearance;  ///< added to theirs, length: a clearance (+) or an interference (-) that is not drawn
  std::vector<char>
      one_line{};  ///< of each edge of the multiplier side, whether both lines are one there; empty: of none
  std::optional<ArcLength> s{};  ///< along the multiplier side, where these two ask for it
  Model model = {};
  bool beyond_steps = false;  ///< whether all that faces counts on the far side of steps too: a fluid presses on it

  /// From a place on the multiplier side's edges along the normal there.
  Line line_from(const Points& nodes, const Curve& curve, const Place& at) const;

  /// Undeformed, along a line from a place of the multiplier side that hits the opposite side; length, positive when
  /// open. Throws SceneError where a field of the scene has no finite value.
  double initial_gap(const Line& line, const Place& at, const Hit& hit) const;

  /// The clearance that the scene adds to the gap of the lines at a place of the multiplier side's edges, length.
  double clearance_at(const Vec2& x, const Place& at) const;
};

}  // namespace mortise
