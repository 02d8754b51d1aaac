// Where the nodes of a contact pair lie and what they face, undeformed: alike for all loads on one mesh.
#pragma once

#include <optional>
#include <vector>

#include "problem/problem.hpp"

namespace mortise {

/// The line along the normal at a place of the multiplier side, and where it meets the opposite side.
struct Facing {
  Line line;
  Hit on_opposite;
};

/// A node of either curve.
struct FacingNode {
  int node;
  double s;                       ///< arc length, from where its curve begins
  Place place;                    ///< on one of the edges of its curve that meet there
  Vec2 own_normal;                ///< mean of these edges' normals; at an end on a symmetry plane in that plane
  Vec2 normal;                    ///< of the multiplier side there; of a node that faces nothing, against its own
  Place on_multiplier{-1, 0};     ///< on the multiplier side, where p is taken; edge -1: nowhere
  std::optional<Facing> faces{};  ///< from there; none: it faces nothing
};

/// The middle of an edge.
struct EdgeMiddle {
  double s;
  Vec2 position, normal;
};

struct CurveNodes {
  std::vector<FacingNode> nodes;    ///< in the curve's order
  std::vector<EdgeMiddle> middles;  ///< of its edges
  double length;
};

struct ContactNodes {
  CurveNodes multiplier, opposite;
};

/// One a pair. The constraints are the scene's, without motions that are held as nothing else holds them.
std::vector<ContactNodes> contact_nodes(const Problem& problem);

}  // namespace mortise
