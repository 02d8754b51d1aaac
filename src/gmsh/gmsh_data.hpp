// The mesh that gmsh has open, as plain data. No gmsh header here.
#pragma once

#include "mesh_files/mesh_data.hpp"

namespace mortise {

/// Throws InputError, naming `file`, where gmsh has made a node whose coordinates are not finite.
MeshData gmsh_data(const std::string& file);

}  // namespace mortise
