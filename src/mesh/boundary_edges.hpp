// The boundary of every body, named or not: the sides that belong to one of its cells only.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace mortise {

/// A side of one cell of its body. The body lies on the left of the edge.
struct BoundaryEdge {
  Edge edge;
  CellSide side;
  int body;     ///< index into Mesh::bodies
  int piece;    ///< cells of a body that hang together by common sides: a number for all pieces of all bodies
  bool shared;  ///< another body has a cell on the other side: the two are bonded there
};

struct BoundaryEdges {
  std::vector<BoundaryEdge> edges;  ///< by piece
  std::vector<int> piece_of_cell;
  int pieces = 0;
};

/// Linear in the number of cells.
/// Throws InputError, with coordinates, where two cells lie on the same side of an edge: listed twice, or over another.
BoundaryEdges boundary_edges(const Mesh& mesh);

/// For each edge the boundaries (indices into Mesh::boundaries) that it belongs to.
std::vector<std::vector<int>> names_of(const Mesh& mesh, const std::vector<BoundaryEdge>& edges);

}  // namespace mortise
