// Sizes and places of bodies and boundaries, which distinguish them.
#pragma once

#include "mesh/mesh.hpp"

namespace mortise {

/// An area or a length, and the centre of it.
struct Measure {
  double size = 0;
  Vec2 centre = Vec2::Zero();
};

/// Measures of each body and boundary, by the polygons through their nodes.
std::vector<Measure> body_measures(const Mesh& mesh);
std::vector<Measure> boundary_measures(const Mesh& mesh);

}  // namespace mortise
