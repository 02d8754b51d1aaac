// Flat triangles that gmsh leaves along lines with edges far below the size of the whole.
#pragma once

#include "mesh_files/mesh_data.hpp"

namespace mortise {

/// Swaps the longest side of each triangle that has its three corners in line, with the triangle beyond, for the side
/// from the middle corner to the far one: no node moves but a middle of the new side. Flat triangles beside flat ones
/// go one after the other; one with nothing beyond stays.
void swap_flat_triangles(MeshData& data);

}  // namespace mortise
