// Sizes of a first mesh.
#pragma once

#include "gmsh/free_mesher.hpp"
#include "mesh/layered_sizes.hpp"
#include "scene/scene.hpp"

namespace mortise {

/// The contact curves of a scene in so many edges, and arcs in turns of 15 degrees.
LayeredSizes drawn_sizes(const std::vector<DrawnCurve>& curves, const Scene& scene, int edges);

}  // namespace mortise
