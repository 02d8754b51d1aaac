// Places of the bodies themselves at which their stress has no limit, contact apart: re-entrant corners, tips of slits,
// ends of supports, and where materials that are bonded meet. docs/theory.md, section 8.
#pragma once

#include "contact/williams.hpp"
#include "fem/constraints.hpp"
#include "mesh/side_table.hpp"

namespace mortise {

/// Exponents above this count as regular: r^-0.05 doubles within a million edges.
inline constexpr double singular_limit = 0.95;

/// The sides of cells that end at a node and have no cell behind them, the body on their left.
std::vector<Edge> outline_at(const Mesh& mesh, const SideTable& table, int node);

/// The bodies whose cells stand around a node, counter-clockwise from the side to the node `first`, each with the angle
/// of its cells one beside the other, radians; whether they come back to that side.
struct AnglesAround {
  std::vector<std::pair<int, double>> angles;
  bool closed;
};
AnglesAround bodies_around(const Mesh& mesh, std::span<const SideAtNode> sides, int first);

/// The condition on a face, by what is prescribed at all nodes of its edge.
Face face_of(const Points& nodes, const Edge& edge, const Constraints& constraints);

/// Of a body on the left of an outline that goes on from one tangent to the other, radians in (0, 2 pi).
double interior_angle(const Vec2& before, const Vec2& after);

/// A vertex of the mesh around which u ~ r^exponent.
struct BodyCorner {
  int node;
  Vec2 position;
  double exponent;  ///< real part, at most singular_limit
};

/// What stands around the vertices of a mesh: sides, what holds them, laws (one a body), and the exponents found so
/// far.
struct Surroundings {
  const Mesh& mesh;
  const SideTable& table;
  const Constraints& constraints;
  const std::vector<ElasticLaw>& laws;
  TipTable& tips;
};

/// All of them, as the edges of the mesh turn at the outlines' vertices and as the nodes of these edges are held. Faces
/// in contact count as free, and so do tied ones. Time as the nodes; exponents are found once for corners that are
/// alike to 1e-4 radians.
std::vector<BodyCorner> body_corners(const Surroundings& around);

/// The exponent of one body's own corner at a node, its faces free of contact: 1 where it has none below, and inside.
double corner_exponent(const Mesh& mesh, int node, const Constraints& constraints, const ElasticLaw& law);

}  // namespace mortise
