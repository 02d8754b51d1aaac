// What the forces of contact and of supports are off by.
#pragma once

#include "error/error_estimate.hpp"

namespace mortise {

/// What is to be known of the forces of the pairs: along x and y, and the moment about a centre.
struct ForcesAsked {
  struct One {
    std::size_t pair;
    int component;
  };
  std::vector<Eigen::Vector3d> by_statics;  ///< errors that equilibrium gives, a pair each; NaN: it does not
  std::vector<One> by_duals;                ///< those left, if they are not too many
  MatX rows;                                ///< of these, m x count: functionals as of ContactFactor::duals
};

/// `centres`: one a pair.
ForcesAsked ask_forces(const Problem& problem, const Solution& solution, const std::vector<Vec2>& centres,
                       EstimateMemory& memory);

/// Of each pair what the force on the multiplier side's body along x and y, and its moment about a centre, may be off
/// by, times depth (model/model.hpp). Each is a functional of its own: a motion of that side by 1, with a dual solution
/// (docs/theory.md, section 14). Where equilibrium fixes the force that is a rigid motion, which has no error:
/// round-off of the forces is left, and nothing is solved for. Where more than most_own_duals are not fixed, and with
/// multi-point constraints, they are sums of the bars of p. `duals`: of asked.rows, with what overlaps at borders do in
/// their sums.
std::vector<Eigen::Vector3d> force_errors(const Problem& problem, const std::vector<PressureEstimate>& pressures,
                                          const std::vector<Vec2>& centres, const ForcesAsked& asked,
                                          const FoundDuals& duals);

/// The same with duals of its own. `solution`: as of estimate_error.
std::vector<Eigen::Vector3d> force_errors(const Problem& problem, const Solution& solution,
                                          const std::vector<PressureEstimate>& pressures,
                                          const std::vector<Vec2>& centres, EstimateMemory& memory);

}  // namespace mortise
