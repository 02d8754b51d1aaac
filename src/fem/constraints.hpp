// Prescribed displacements.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace mortise {

/// Degrees of freedom whose displacement is given. Both have one entry a degree of freedom.
struct Constraints {
  std::vector<char> fixed;
  VecX value;  ///< length; zero where not fixed
};

Constraints no_constraints(const Mesh& mesh);

/// Prescribes component 0 or 1 on a boundary. Throws InputError, with coordinates, where another value already
/// stands at a node (boundaries may share nodes, but must agree there).
void prescribe(const Mesh& mesh, int boundary, int component, double value, Constraints& constraints);

/// True if the displacement of a node along the unit vector n is prescribed.
bool prescribed_along(const Constraints& constraints, int node, const Vec2& n);

}  // namespace mortise
