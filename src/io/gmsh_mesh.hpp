// Meshes from gmsh: a .geo is meshed in process, a .msh (2.2 or 4.1, ASCII or binary) is read.
#pragma once

#include <map>
#include <string>

#include "mesh/mesh.hpp"

namespace mortise {

/// The mesh of `file`; `parameters` set DefineConstant names of a .geo.
/// Bodies are the named physical surfaces, boundaries the named physical curves; nodes of no body are left out.
/// Throws InputError naming the file and the place: no such file, gmsh's own message, a parameter the .geo does not
/// define, parameters given to a .msh, an element kind that is not supported, a surface or physical curve without a
/// name, no body at all, a cell in two bodies, a mesh that leaves the plane z = 0.
Mesh load_mesh(const std::string& file, const std::map<std::string, double>& parameters);

/// Meshes `file` and writes the mesh as `output` (.msh, format 4.1), atomically. Throws as load_mesh does.
void write_msh(const std::string& file, const std::map<std::string, double>& parameters, const std::string& output);

}  // namespace mortise
