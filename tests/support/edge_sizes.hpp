// Edges of a mesh beside the sizes that were asked for.
#pragma once

#include "gmsh/gmsh_module.hpp"
#include "mesh/mesh.hpp"

namespace mortise::test {

inline Vec2 place(const Mesh& mesh, int node) { return mesh.nodes.row(node).transpose(); }

/// The length of an edge over what was asked for in its middle.
inline double size_ratio(const Mesh& mesh, const Edge& edge, const SizeAt& size) {
  const Vec2 a = place(mesh, edge.nodes[0]), b = place(mesh, edge.nodes[1]);
  return (b - a).norm() / size((a + b) / 2);
}

}  // namespace mortise::test
