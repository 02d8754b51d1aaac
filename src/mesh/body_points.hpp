// The nodes of each body as a numbering of its own: a node that two bodies share counts once in each.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace mortise {

/// Points first[b] .. first[b + 1] - 1 belong to body b; node[p] is the mesh node of point p, ascending in a body.
struct BodyPoints {
  std::vector<int> first;
  std::vector<int> node;
};

BodyPoints body_points(const Mesh& mesh);

/// The cells with body points for nodes.
std::vector<Cell> cells_on_points(const Mesh& mesh, const BodyPoints& points);

/// For each body the first of those that it hangs together with by common nodes: itself if there are none.
std::vector<int> bonded_to(const Mesh& mesh, const BodyPoints& points);

/// Two bodies with nodes in common: there they are one piece.
struct SharedNodes {
  int first, second;  ///< bodies
  int count;
  Vec2 position;  ///< of the middle one of them, by number
};

/// All that share nodes, with the first body that has each node.
std::vector<SharedNodes> shared_nodes(const Mesh& mesh, const BodyPoints& points);

/// The point of a node in a body that has it.
int point_of(const BodyPoints& points, int body, int node);

}  // namespace mortise
