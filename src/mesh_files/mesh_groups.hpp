// The physical groups of a mesh: are bodies and boundaries what they must be?
#pragma once

#include "mesh_files/mesh_data.hpp"

namespace mortise {

/// Calls groups without a name surface_3, curve_7, point_1 by their tags.
void name_groups(MeshData& data);

/// In a file without physical curves and surfaces each curve and surface with elements is a group of its own.
void group_by_entity(MeshData& data);

/// The curves and surfaces on which cells lie and that are in no group become groups, called by their own tags.
void group_the_rest(MeshData& data);

/// Throws InputError, naming file and place: a group with control characters in it or with the name of
/// another of its dimension; no physical surface; a surface with cells in no physical surface or in two.
void check_groups(const MeshData& data);

}  // namespace mortise
