// Places where the outline of one piece meets that of another, or lies inside it, as drawn.
#pragma once

#include "problem/audited_bodies.hpp"

namespace mortise {

/// An edge and another piece: what its points see of that piece.
struct Encounter {
  int edge;                 ///< index into Outline::edges
  int piece;                ///< the other one
  double meets = 0;         ///< length along which they face each other at no distance, and no pair stands between them
  double inside = 0;        ///< length inside the other piece, or along its outline with both on one side
  double depth = 0;         ///< the deepest point inside
  double overlap = 0;       ///< int depth ds: about the area that both cover
  std::vector<int> facing;  ///< edges of the other piece
};

/// All encounters of different pieces, by piece, other piece and edge. No distance: less than 1 % of the edges and what
/// two meshes of one curve show; beside a pair's end, where a gap opens slowly, 0.1 % along a whole edge.
std::vector<Encounter> encounters(const AuditedBodies& bodies);

}  // namespace mortise
