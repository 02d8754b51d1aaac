// The physical groups of a mesh: are bodies and boundaries what they must be?
#pragma once

#include "io/mesh_data.hpp"

namespace mortise {

/// Throws InputError, naming file and place: a group without a name, with control characters in it or with the name of
/// another of its dimension; no physical surface; a surface with cells in no physical surface or in two.
void check_groups(const MeshData& data);

}  // namespace mortise
