// The course of the curves that gmsh has drawn between the nodes of their meshes. No gmsh header here.
#pragma once

#include "mesh_files/mesh_data.hpp"

namespace mortise {

/// Sets the samples of a block of edges of the model that gmsh has open, or says in `undrawn` why there are none: gmsh
/// has no formula for the curve, or the mesh does not follow it. Neither where the curve is a mesh itself. `nodes`:
/// MeshData's; `tags`: gmsh's, of the block's nodes; `shift`: gmsh_data's. Only places are asked for, no derivatives:
/// those of a Bezier curve are three times too large in gmsh 4.8.
void sample_curve(const std::vector<std::array<double, 3>>& nodes, const std::vector<std::size_t>& tags,
                  const Vec2& shift, ElementBlock& block);

/// A curve of a geometry.
struct DrawnCurve {
  std::vector<std::string> names;  ///< of the physical curves that it belongs to; there may be none
  std::vector<Vec2> places;        ///< 129 along it, even in its parameter; the first and the last are its ends
};

/// The curves round the surfaces of the model that gmsh has open and those of its named physical curves, by tag.
std::vector<DrawnCurve> drawn_curves();

/// What gmsh takes for the speed of a curve over the true one, by which it errs in the length of its edges: 1 / p for a
/// Bezier curve of degree p in gmsh 4.8, otherwise 1. By differences of places.
double speed_factor(int curve);

}  // namespace mortise
