// Fluid in the gaps of contact pairs: how far it gets, and what it presses with.
#pragma once

#include "problem/problem.hpp"

namespace mortise {

/// The rows that fluids may wet, all dry. Throws SceneError for a place further from its pair's multiplier side than
/// that is long.
VecX dry_rows(const Mesh& mesh, const std::vector<ContactPair>& pairs, Eigen::Index rows);

/// Lets the fluid of each pair go on from its places along the line, vertex by vertex, as far as these are open, face
/// nothing, or carry less than the fluid's pressure; it never draws back. The rows that it wets get its pressure, and
/// f the forces of it on both faces. Whether any is new. `solution`: of the f that there is, lambda without fluids.
bool spread_fluids(const Solution& solution, Problem& problem);

/// From one of the system with the fluids' forces in f to one of the system without: they are part of lambda.
void add_fluids(Problem& problem, Solution& solution);

}  // namespace mortise
