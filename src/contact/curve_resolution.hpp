// How well a mesh follows its contact curve: what its edges miss, and the gaps that two meshes of one curve show
// although the curve has none.
#pragma once

#include <optional>

#include "contact/segments.hpp"

namespace mortise {

/// For each edge of a curve, how far it may lie from the curve that it stands for, length: h theta / 8, the sagitta of
/// an arc of length h that turns by theta, the larger angle of the mesh's kinks at the edge's ends; and of 3-node edges
/// what a parabola misses of a curvature kappa that changes along it (docs/theory.md eq. 28). An estimate, up to 4
/// times too large where only kinks tell; of equal size on both sides of a true corner, which it cannot tell from a
/// mesh's.
std::vector<double> sagittas(const Points& nodes, const Curve& curve);

/// The most that two meshes of one curve are apart, by the sagittas and the longer one of two edges; `slack`: part of
/// it.
double one_curve_gap(double sagitta, double other_sagitta, double longer_edge, double slack = 0.01);

/// A contact point whose gap is more than two meshes of one curve can show, and what they can.
struct OpenPlace {
  Vec2 position;  ///< on the multiplier side
  double gap, limit;
};

/// The point whose gap is furthest above its limit, one_curve_gap; nothing if all gaps are within.
std::optional<OpenPlace> open_place(const Points& nodes, const ContactInterface& interface, double slack = 0.01);

struct Turn {
  double angle;  ///< radians
  Vec2 position;
};

/// The edge that turns most from its start to its end, or with 2-node edges from one edge's middle to the next's.
Turn sharpest_edge(const Points& nodes, const Curve& curve);

/// The sharpest kink of `curve` (a vertex where its edges' tangents differ by more than 20 degrees) that has no vertex
/// of `other` within 1 % of the edges there. Only of 3-node edges: those of 2 nodes turn at every vertex of a curved
/// line.
std::optional<Turn> missed_kink(const Points& nodes, const Curve& curve, const Curve& other);

}  // namespace mortise
