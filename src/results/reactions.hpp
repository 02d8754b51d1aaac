// Reactions: the forces of supports on the bodies.
#pragma once

#include "model/resultant.hpp"
#include "problem/problem.hpp"
#include "results/joint_stiffness.hpp"

namespace mortise {

/// One curve or point of a support. A node that several hold along one direction counts for the first curve that names
/// it, where there is none for the first point.
struct Reaction {
  int entry;       ///< of Entries::boundaries
  std::string on;  ///< name of the curve or point
  Vec2 centre;     ///< of the curve, its mean place along its length; of a point its nodes' mean place
  Resultant sum;
};

/// Forces on the bodies, times depth (model/model.hpp).
struct Reactions {
  VecX nodal;                      ///< n: K u - f + B^T lambda at prescribed and tied unknowns, and the springs' forces
  std::vector<Reaction> curves;    ///< in the scene's order, of an entry its curves first
  std::vector<Resultant> entries;  ///< sums of each of Entries::boundaries, zero of loads
  std::vector<Resultant> ties;     ///< on the nodes that follow, of Mesh::ties
  std::map<int, double> overlaps;  ///< length, + into each other: of those with pretension or overlap
  /// Of Discretisation::multipoint: displacement of `about`, and the turn in radians.
  std::vector<Eigen::Vector3d> rigid_motions;
  std::vector<JointStiffness> stiffnesses;
  Resultant held;                      ///< of the motions that nothing holds (validate.hpp)
  std::vector<Resultant> held_bodies;  ///< the same of each body of the mesh, nodes that several share with the first
  Resultant loads;                     ///< of all nodes; initial strains, which are in balance, left out
  Resultant all;                       ///< of supports and held motions
};

Reactions find_reactions(const Problem& problem, const Solution& solution);

}  // namespace mortise
