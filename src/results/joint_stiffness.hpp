// How stiff a support meets what it holds: force and moment against its motion, contact closed as it is.
#pragma once

#include "problem/problem.hpp"
#include "solve/solution.hpp"

namespace mortise {

/// Of one entry that asks for it (BoundarySpec::stiffness).
struct JointStiffness {
  int entry;   ///< of Entries::boundaries
  Vec2 about;  ///< which it turns, and its moment is
  /// What moving the support by 1 along x, along y, and turning it by 1 radian (columns) changes of the force along x
  /// and y and of the moment that it puts on the bodies (rows), times depth (model/model.hpp); symmetric. Zero along
  /// what the entry does not hold; of rings along the axis alone. A rigid curve's is that with all three held, whatever
  /// is prescribed of it. None where motions that nothing holds leave it open.
  std::optional<Eigen::Matrix3d> matrix;
};

/// In the order of the entries: three questions each to the factor of the closed rows (docs/theory.md, section 7).
/// `solution`: converged, or there are none.
std::vector<JointStiffness> joint_stiffnesses(const Problem& problem, const Solution& solution);

}  // namespace mortise
