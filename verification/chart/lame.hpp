// Lame's solution of two concentric rings in contact under pressure.
#pragma once

#include "mesh/mesh.hpp"
#include "scene/scene.hpp"

namespace mortise::chart {

/// u_r = A r + B / r in each ring, plane strain. Rings are bodies of the mesh; radii in the scene's units.
struct Lame {
  std::vector<double> A, B, lambda, mu;  ///< of each body
  double pressure = 0;                   ///< between the rings
  Vec2 displacement(const Vec2& x, int body) const;
  Vec4 stress(const Vec2& x, int body) const;
};

/// The rings of geo/rings.geo (radii 1, 2, 3; bodies inner, outer; boundaries inner_bore, outer_rim) with the materials
/// and pressures of the scene.
Lame lame_of(const Scene& scene, const Mesh& mesh);

}  // namespace mortise::chart
