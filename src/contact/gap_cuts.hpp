// Cuts where a gap that is given, or added to that of the curves, varies within edges of the multiplier side.
#pragma once

#include <array>

#include "contact/contact_geometry.hpp"
#include "fem/line_cuts.hpp"

namespace mortise {

/// The field that the gap is, or that is added to it.
const Field& gap_field(const ContactGeometry& geometry);

/// Its slope at both ends of the multiplier side, away from them.
std::array<double, 2> gap_slopes_at_ends(const Points& nodes, const Curve& multiplier, const ContactGeometry& geometry);

/// It along an edge of the multiplier side. `range`: its own; all that is given must outlive the function.
LineFunction gap_along(const Points& nodes, const Curve& multiplier, const ContactGeometry& geometry, int edge,
                       const FieldRange& range);

/// By how much it varies along the multiplier side.
double gap_scale(const Points& nodes, const Curve& multiplier, const ContactGeometry& geometry,
                 const FieldRange& range);

/// Cuts of each edge, as resolving_cuts. None at all where the field is constant.
std::vector<std::vector<double>> gap_cuts(const Points& nodes, const Curve& multiplier,
                                          const ContactGeometry& geometry);

}  // namespace mortise
