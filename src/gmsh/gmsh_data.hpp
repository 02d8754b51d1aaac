// The mesh that gmsh has open, as plain data. No gmsh header here.
#pragma once

#include <map>
#include <vector>

#include "mesh_files/mesh_data.hpp"

namespace mortise {

/// `shift`: by which the geometry lies elsewhere than it is drawn; the mesh is moved back. `drawn`: by tag the groups
/// of curves that meshing may have changed. Throws InputError, naming `file`, where gmsh has made a node whose
/// coordinates are not finite.
MeshData gmsh_data(const std::string& file, const Vec2& shift, const std::map<int, std::vector<int>>& drawn = {});

}  // namespace mortise
