// Places of the bodies themselves at which their stress has no limit, contact apart: re-entrant corners, tips of slits,
// ends of supports, and where materials that are bonded meet. docs/theory.md, section 8.
#pragma once

#include "contact/tied_vertices.hpp"
#include "contact/tip_table.hpp"
#include "fem/constraints.hpp"

namespace mortise {

/// Exponents above this count as regular: r^-0.05 doubles within a million edges.
inline constexpr double singular_limit = 0.95;

/// The sides of cells that end at a node and have no cell behind them, the body on their left.
std::vector<Edge> outline_at(const Mesh& mesh, const SideTable& table, int node);

/// The condition on a face, by what is prescribed at all nodes of its edge.
Face face_of(const Points& nodes, const Edge& edge, const Constraints& constraints);

/// Of a direction, counter-clockwise from x_1, radians.
double angle_of(const Vec2& direction);

/// Of a body on the left of an outline that goes on from one tangent to the other, radians in (0, 2 pi).
double interior_angle(const Vec2& before, const Vec2& after);

/// What stands around the vertices of a mesh: sides, ties, what holds them, laws (one a body), and the exponents found
/// so far.
struct Surroundings {
  const Mesh& mesh;
  const SideTable& table;
  const TiedVertices& ties;
  const Constraints& constraints;
  const std::vector<ElasticLaw>& laws;
  TipTable& tips;
};

/// A body at a vertex, with the angle of its cells one beside the other, radians.
struct BodyAtVertex {
  int body;
  int node;  ///< its own; -1 within an edge
  double angle;
  double first;     ///< direction of the first of their sides, radians
  double turn = 0;  ///< as of AcrossTie, from the vertex that was asked for
};

/// What is around a vertex from one face to another, counter-clockwise and across ties.
struct BodiesAtVertex {
  std::vector<BodyAtVertex> bodies;
  EdgeAtVertex first, last;  ///< edges of the outline, or none
  bool closed = false;       ///< last and first are tied to each other, or there are none
  double turn = 0;           ///< of closed ones: as of AcrossTie, once around
};

/// What is around the vertex of an edge of the outline that begins or ends there.
BodiesAtVertex bodies_at(const Surroundings& around, const EdgeAtVertex& face);

/// The condition on an edge of the outline; free: none.
Face face_at(const Surroundings& around, const EdgeAtVertex& face);

/// A vertex of the mesh around which u ~ r^exponent.
struct BodyCorner {
  int node;
  Vec2 position;
  double exponent;  ///< real part, at most singular_limit
};

/// All of them, as the edges of the mesh turn at the outlines' vertices and as the nodes of these edges are held. Faces
/// in contact count as free. Time as the nodes; exponents are found once for corners that are alike to 1e-4 radians.
std::vector<BodyCorner> body_corners(const Surroundings& around);

/// The exponent at a node, faces in contact free: 1 where it has none below, and inside a body.
double corner_exponent(const Surroundings& around, int node);

}  // namespace mortise
