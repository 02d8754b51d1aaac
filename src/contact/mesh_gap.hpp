// Gaps that two meshes of one curve show although the curve has none.
#pragma once

#include <optional>
#include <span>

#include "contact/segments.hpp"

namespace mortise {

/// For each edge of a curve, how far it may lie from the curve that it stands for: h theta / 8, the sagitta of an arc
/// of length h that turns by theta. theta is the angle by which the mesh turns there: between the edge's own ends, or
/// its middle and its neighbours' middles, whichever is larger. Length.
std::vector<double> sagittas(const Points& nodes, const Curve& curve);

/// A contact point whose gap is more than two meshes of one curve can show, and what they can.
struct OpenPlace {
  Vec2 position;  ///< on the multiplier side
  double gap, limit;
};

/// The point whose gap is furthest above its limit, which is twice the two edges' sagittas and `slack` of the longer
/// edge; nothing if all gaps are within.
std::optional<OpenPlace> open_place(const Points& nodes, const Curve& multiplier, const Curve& opposite,
                                    std::span<const ContactPoint> points, double slack = 0.01);

}  // namespace mortise
