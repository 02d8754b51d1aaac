// Transfer between the curves of a pair by nodal values, as solvers that know nothing of one another's meshes do it.
#pragma once

#include "contact/coupling.hpp"

namespace mortise {

/// Instead of the mortar projection (docs/theory.md eq. 34): the opposite side's displacement is taken at the nodes of
/// the multiplier side and interpolated there, the pressure at the nodes of the opposite side and interpolated there.
/// Replaces the opposite side's columns of coupling.B, and fills coupling.loads: on meshes that do not match the forces
/// on both sides are no longer equal and opposite, and the transposed B no longer gives them.
/// Points are found along the mean normals of the nodes; an end that misses by less than a tenth of an edge takes the
/// other curve's nearest node.
void transfer_by_nodes(const Mesh& mesh, const Curve& multiplier, const Curve& opposite, Coupling& coupling);

}  // namespace mortise
