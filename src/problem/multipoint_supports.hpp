// Supports that tie unknowns together: displacements along any direction, rigid curves, tied meshes.
#pragma once

#include "fem/multipoint.hpp"
#include "problem/boundary_entries.hpp"
#include "solve/saddle_point_system.hpp"

namespace mortise {

/// A rigid curve and the entry of Entries::boundaries that makes it.
struct RigidSupport {
  int entry;
  RigidCurve curve;
};

struct MultipointSupports {
  std::vector<RigidSupport> rigid_curves;
  std::map<int, HeldTwice> held_twice;  ///< by node; supports are of Entries::boundaries
  std::map<int, TieOverlap> overlaps;   ///< by number in Mesh::ties
  VecX pretension;                      ///< n: the part of the load that draws ties together; empty: none does
};

/// Adds those of all entries, after all that is prescribed along x and y, and the forces on rigid curves to the load.
/// A normal is the mean of the edges' at a node; where they differ by more than 15 degrees, both are held. Throws
/// SceneError where two entries contradict each other.
MultipointSupports add_multipoint_supports(const std::vector<BoundaryEntry>& entries, const Mesh& mesh,
                                           SaddlePointSystem& system);

}  // namespace mortise
