// The outlines of all bodies, named or not, and where a point lies to them.
#pragma once

#include <array>

#include "mesh/boundary_edges.hpp"
#include "mesh/box_index.hpp"

namespace mortise {

/// One piece of a body: edges first .. last - 1.
struct PieceOutline {
  int body;
  int first, last;
  Box box;
  double area = 0, perimeter = 0;
  BoxIndex edges;  ///< number k is edge first + k
};

/// The least angle of a corner: up to it two edges that meet are taken for one smooth curve.
inline constexpr double smooth_turn = 0.6;  // 34 degrees

/// Boundary edges at given positions of the nodes.
struct Outline {
  Points nodes;
  std::vector<BoundaryEdge> edges;
  std::vector<std::array<int, 2>> neighbour;       ///< edges before and after each one along its piece; -1: none
  std::vector<std::array<Vec2, 2>> vertex_normal;  ///< at each edge's start and end: mean of the two edges that meet
  std::vector<std::array<double, 2>> turn;         ///< there, the angle between them, radians; 0: no neighbour
  std::vector<double> length;
  std::vector<double> sagitta;  ///< how far the curve that an edge stands for may lie from it, by its smooth turns
  std::vector<PieceOutline> pieces;
  BoxIndex boxes;  ///< of the pieces
};

Outline outline(const BoundaryEdges& boundary, const Points& nodes);

/// The place of a piece's outline that is nearest to a point.
struct OutlinePlace {
  int edge;  ///< index into Outline::edges
  double xi;
  double distance;  ///< from the outline, negative inside the body
  Vec2 normal;      ///< outward; at a vertex the mean one
  bool vertex;      ///< the nearest place is an end of the edge
};

OutlinePlace nearest(const Outline& outline, int piece, const Vec2& x);

/// An edge's box, larger by `margin` all around.
Box edge_box(const Outline& outline, int edge, double margin);

}  // namespace mortise
