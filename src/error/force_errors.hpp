// What the forces of contact and of supports are off by.
#pragma once

#include "error/error_estimate.hpp"

namespace mortise {

/// A force whose error is asked for: that of a pair on the multiplier side's body, or of supports in some unknowns.
struct ForcePlace {
  int pair = -1;              ///< -1: of supports
  std::vector<int> unknowns;  ///< prescribed ones
  Vec2 centre;                ///< about which moments are
};

/// Of each place what the force along x and y and its moment about the centre may be off by, times depth
/// (base/model.hpp). Each is a functional of its own: a motion of what the force acts on by 1, with a dual solution
/// (docs/theory.md, section 14). Where equilibrium fixes the force that is a rigid motion, which has no error:
/// round-off of the forces is left, and nothing is solved for. Where more than most_own_duals are not fixed, a pair's
/// are sums of the bars of p, and those of supports NaN; as they are with multi-point constraints. `solution`: as of
/// estimate_error.
std::vector<Eigen::Vector3d> force_errors(const Mesh& mesh, const BodyPoints& points,
                                          const Discretisation& discretisation, const std::vector<ContactPair>& pairs,
                                          const Solution& solution, const std::vector<PressureEstimate>& pressures,
                                          const std::vector<ForcePlace>& places);

}  // namespace mortise
