// Cells and edges that a mesh file lists twice: they would count twice in the stiffness and the loads.
#pragma once

#include "mesh/mesh.hpp"

namespace mortise {

/// Throws InputError, with coordinates, where two cells have the same corners, or two edges of one boundary the same
/// ends.
void check_no_repetition(const Mesh& mesh);

}  // namespace mortise
