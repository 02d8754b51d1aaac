// Bodies that are one where their meshes do not match.
#pragma once

#include "fem/multipoint.hpp"

namespace mortise {

struct Scene;

/// The mesh with its ties, the nodes that follow moved to where their weights have them (Puso 2004): on curves, by what
/// the two meshes leave between each other, so that a tied body turns without strain. Overlaps that are locked are
/// those of the same ties in `mesh`, if it has them. Throws SceneError, with the place, where the curves are more than
/// a tenth of an edge apart, and where one with pretension is not straight.
Mesh tied(const Scene& scene, Mesh mesh);

/// Ties the displacements; after all other supports. The overlaps by their number in Mesh::ties.
std::map<int, TieOverlap> add_ties(const Mesh& mesh, MultipointBuilder& builder);

/// What the scene says of pretension and overlap, into the ties of its mesh; what is locked stays.
void take_pretensions(const Scene& scene, Mesh& mesh);

}  // namespace mortise
