// Prescribed displacements on boundaries.
#pragma once

#include <functional>

#include "base/constraints.hpp"
#include "mesh/mesh.hpp"

namespace mortise {

Constraints no_constraints(const Mesh& mesh);

/// Prescribes unknown `dof` at a node that is called `name`, for messages.
void prescribe(const Mesh& mesh, const std::string& name, int dof, double value, Constraints& constraints);

/// The same on a boundary, by the value at each node. Throws InputError, with coordinates, where
/// another value already stands at a node (boundaries may share nodes, but must agree there up to round-off).
void prescribe(const Mesh& mesh, int boundary, int component, const std::function<double(int node)>& value,
               Constraints& constraints);
void prescribe(const Mesh& mesh, int boundary, int component, double value, Constraints& constraints);

/// Of rings, whose axis is x1 = 0: holds u1 of the nodes there; no rigid motion but along x2 is left. Throws
/// InputError, with the place, where x1 is negative.
void hold_axis(const Mesh& mesh, Constraints& constraints);

/// True if the displacement of a node along the unit vector n is prescribed.
bool prescribed_along(const Constraints& constraints, int node, const Vec2& n);

/// Prescribed displacement of a node, length; zero along directions in which it is free.
Vec2 prescribed_displacement(const Constraints& constraints, int node);

/// Directions, none to two, in which a node is held: unit vectors at right angles. A node of a rigid curve is held by
/// the others.
std::vector<Vec2> prescribed_directions(const Constraints& constraints, int node);

/// Forces in all unknowns that the constraints of the `chosen` q make, of the residual K u - f + B^T lambda.
VecX constraint_forces(const Constraints& constraints, const std::vector<char>& chosen, const VecX& residual);

}  // namespace mortise
