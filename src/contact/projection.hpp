// From one curve to the other: along a straight line, and back onto a curve along its own normals.
#pragma once

#include <optional>

#include "fem/elements.hpp"
#include "mesh/curve.hpp"

namespace mortise {

/// The place where a line meets an edge of a curve.
struct Hit {
  int edge;         ///< index into Curve::edges
  double xi;        ///< on that edge, [-1, 1] up to projection_tolerance
  double distance;  ///< signed, along the line's direction, length
};

/// Reference coordinates this far outside [-1, 1] still count as on the edge.
inline constexpr double projection_tolerance = 1e-9;

/// How far another body may reach into this one behind an edge of its curve and still be in contact there, not at its
/// far side: half the body's thickness, length. Without limit where the curve has none.
double deepest_overlap(const Curve& curve, int edge);

/// A line out of a body, from a place on its contact curve.
struct Line {
  Vec2 x, n;     ///< n: unit, out of the body
  double depth;  ///< how far behind x the other curve may lie, length: deepest_overlap of the edge that x lies on
};

/// From a place on an edge of a curve, along the edge's normal there.
Line line_from(const Points& nodes, const Curve& curve, int edge, double xi);

/// Where the line x + distance * n meets the edge: the roots of (edge(xi) - x) x n = 0, a polynomial of the edge's
/// own degree (docs/theory.md eq. 8), solved in closed form. Only where the edge faces the line (its outward normal
/// against n) and lies no deeper behind x than both bodies allow (Line::depth, deepest_overlap of the edge), x within
/// the other body; of two such places the one nearer to x.
std::optional<Hit> project_onto_edge(const Points& nodes, const Curve& curve, int edge, const Line& line);

/// The nearest of all edges of the curve that face the line. Nothing if the line misses the curve.
std::optional<Hit> project_onto_curve(const Points& nodes, const Curve& curve, const Line& line);

/// Reference coordinate in (-1, 1) where the normal of the edge passes through x: (x - edge(xi)) . edge'(xi) = 0
/// (docs/theory.md eq. 9), by Newton's method, and by bisection where Newton leaves the edge.
std::optional<double> foot_on_edge(const Points& nodes, const Edge& edge, const Vec2& x);

}  // namespace mortise
