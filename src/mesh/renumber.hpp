// Nodes and cells in an order that keeps neighbours close in memory.
#pragma once

#include "mesh/mesh.hpp"

namespace mortise {

/// Sorts the cells by body and, within a body, along a Hilbert curve through their corners' centroids; then numbers
/// the nodes as the cells meet them and drops the others, and the named points that have no more nodes. The same mesh
/// always comes out in the same order. Throws InputError, with coordinates, where a boundary edge has a node of no
/// cell.
void renumber(Mesh& mesh);

}  // namespace mortise
