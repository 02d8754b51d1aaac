// Prescribed displacements on boundaries.
#pragma once

#include "base/constraints.hpp"
#include "mesh/mesh.hpp"

namespace mortise {

Constraints no_constraints(const Mesh& mesh);

/// Prescribes component 0 or 1 on a boundary. Throws InputError, with coordinates, where another value already
/// stands at a node (boundaries may share nodes, but must agree there).
void prescribe(const Mesh& mesh, int boundary, int component, double value, Constraints& constraints);

/// Of rings, whose axis is x1 = 0: holds u1 of the nodes there; no rigid motion but along x2 is left. Throws
/// InputError, with the place, where x1 is negative.
void hold_axis(const Mesh& mesh, Constraints& constraints);

/// True if the displacement of a node along the unit vector n is prescribed.
bool prescribed_along(const Constraints& constraints, int node, const Vec2& n);

}  // namespace mortise
