// Rigid motions as displacements of their own nodes, and unknowns that would hold them.
#pragma once

#include "fem/rigid_motions.hpp"

namespace mortise {

/// Motions that have bodies in common, directly or by others, and their displacements.
struct MotionSet {
  std::vector<int> motions;  ///< ascending
  std::vector<int> nodes;    ///< of their bodies, ascending
  MatX fields;               ///< 2 nodes x motions, component c of node i in row 2 i + c

  int unknown(Eigen::Index row) const { return 2 * nodes[row / 2] + int(row % 2); }
};

/// All motions: floating bodies that nothing joins are a set each.
std::vector<MotionSet> motion_sets(const Mesh& mesh, const std::vector<std::vector<RigidMotion>>& motions);

/// The set's motions at its unknowns, a row for each motion.
MatX motions_at(const MotionSet& set, const std::vector<int>& unknowns);

/// Of motions that have bodies in common, directly or by others, the sum that, added to u (2 nodes), makes the mean
/// square of u over their bodies' areas least: a list for each such set, one entry a body.
std::vector<std::vector<RigidMotion>> least_motions(const Mesh& mesh,
                                                    const std::vector<std::vector<RigidMotion>>& motions,
                                                    const VecX& u);

/// One free unknown for each free motion of single bodies, spread as far apart as they go: springs there would hold
/// the bodies. `motions` as found without contact rows.
std::vector<int> grounding_unknowns(const Mesh& mesh, const Constraints& constraints,
                                    const std::vector<std::vector<RigidMotion>>& motions);

/// For each column of `values` the combination of `motions` in which the grounded `unknowns` move by it, of unit size.
/// One entry a body.
std::vector<std::vector<RigidMotion>> motions_through(const Mesh& mesh,
                                                      const std::vector<std::vector<RigidMotion>>& motions,
                                                      const std::vector<int>& unknowns, const MatX& values);

}  // namespace mortise
