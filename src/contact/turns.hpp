// Where a contact curve turns more than its mesh, or the other side's, can follow.
#pragma once

#include <optional>

#include "fem/elements.hpp"
#include "mesh/curve.hpp"

namespace mortise {

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

/// 3-node edges whose middle nodes lie on the chords although the curve turns at their vertices.
struct StraightSides {
  int vertices;    ///< at which the curve turns by 1 to 20 degrees between straight edges
  double sagitta;  ///< how far the curve lies from the longest such chord, h theta / 8, length
  Vec2 position;   ///< the vertex of that chord
};

/// Nothing below three such vertices: fewer may be kinks that are meant.
std::optional<StraightSides> straight_sides(const Points& nodes, const Curve& curve);

}  // namespace mortise
