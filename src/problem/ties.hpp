// Bodies that are one where their meshes do not match.
#pragma once

#include "fem/multipoint.hpp"

namespace mortise {

struct Scene;

/// The mesh with its ties, the nodes that follow moved to where their weights have them (Puso 2004): on curves, by what
/// the two meshes leave between each other, so that a tied body turns without strain. Throws SceneError, with the
/// place, where the curves are more than a tenth of an edge apart.
Mesh tied(const Scene& scene, Mesh mesh);

/// Ties the displacements; after all other supports.
void add_ties(const Mesh& mesh, MultipointBuilder& builder);

}  // namespace mortise
