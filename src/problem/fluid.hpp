// Fluid in the gaps of contact pairs: how far it gets, and what it presses with.
#pragma once

#include "problem/problem.hpp"

namespace mortise {

/// The rows that fluids may wet, all dry. Throws SceneError for a place further from its pair's multiplier side than
/// that is long.
VecX dry_rows(const Mesh& mesh, const std::vector<ContactPair>& pairs, Eigen::Index rows);

/// What fluid of unit pressure in each row does to the bodies: it presses on each face along that face's own normals,
/// as far as these meet the other face. rows x degrees of freedom, length times depth.
SparseRows fluid_loads(const Mesh& mesh, const Model& model, const std::vector<ContactPair>& pairs, Eigen::Index rows);

/// Lets the fluid of each pair go on from its places along the gap, vertex by vertex of those that face the other side,
/// as far as these are open or carry less than the fluid's pressure; it never draws back. What faces nothing it crosses
/// where the gap goes on behind (a groove), but not from one end of the gap round to the other. The rows that it wets
/// get its pressure, and f the forces of it on both faces. Whether any is new. `solution`: of the f that there is,
/// lambda without fluids.
bool spread_fluids(const Solution& solution, Problem& problem);

/// From one of the system with the fluids' forces in f to one with them in lambda, which has them along the multiplier
/// side's normals; what they are more than that stays in f.
void add_fluids(Problem& problem, Solution& solution);

}  // namespace mortise
