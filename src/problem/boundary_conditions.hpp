// What a [[boundary]] entry does to the equations: prescribed displacements, loads, foundations.
#pragma once

#include "fem/foundation.hpp"
#include "mesh/side_table.hpp"
#include "model/resultant.hpp"
#include "problem/scene_names.hpp"
#include "scene/scene.hpp"
#include "solve/saddle_point_system.hpp"

namespace mortise {

/// Adds the entry's prescribed displacements and loads to the system, and the stiffness of its foundation to `springs`.
/// Returns the sum of the forces that it makes. Throws InputError where the mesh does not have its
/// curves, two values are prescribed at one node, or a field has no value.
Resultant apply(const Mesh& mesh, const Model& model, const SideTable& table, const SceneNames& names,
                const BoundarySpec& spec, SaddlePointSystem& system, std::vector<Eigen::Triplet<double>>& springs);

}  // namespace mortise
