// Where the curves that gmsh has drawn run between the nodes of their meshes. No gmsh header here.
#pragma once

#include "io/mesh_data.hpp"

namespace mortise {

/// Sets the samples of a block of edges of the model that gmsh has open, or says in `undrawn` why there are none: gmsh
/// has no formula for the curve, the mesh does not follow it, or it turns abruptly within an edge, as a Spline does at
/// its ends. Neither where the curve is a mesh itself. `nodes`: MeshData's; `tags`: gmsh's, of the block's nodes. Only
/// places are asked for, no derivatives: those of a Bezier curve are three times too large in gmsh 4.8.
void sample_curve(const std::vector<std::array<double, 3>>& nodes, const std::vector<std::size_t>& tags,
                  ElementBlock& block);

}  // namespace mortise
