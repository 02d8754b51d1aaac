// Meshes from files: a .geo is meshed by gmsh, the others are read by ourselves.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "model/geo_limits.hpp"

namespace mortise {

/// Checks that need not read `file`. Throws InputError naming it: an ending that is not known, no such file,
/// parameters given to another than a .geo, what check_geo refuses.
void check_mesh_file(const std::string& file, const std::map<std::string, double>& parameters);

/// The mesh of `file`; `parameters` set DefineConstant names of a .geo, `limits` what it may do.
/// Bodies are the named physical surfaces, boundaries the named physical curves; nodes of no body are left out.
/// Throws InputError naming the file and the place: no such file, gmsh's own message, a parameter that the .geo does
/// not define or that is outside the range it gives, parameters given to a mesh, what read_msh, read_inp and
/// assemble_mesh refuse, and what gmsh_process.hpp says of a .geo that crashes gmsh, takes too long or runs programs.
/// `cached`: set to whether the mesh of a .geo was kept from an earlier run (mesh_cache.hpp).
Mesh load_mesh(const std::string& file, const std::map<std::string, double>& parameters, const GeoLimits& limits = {},
               bool* cached = nullptr);

/// The same with every body and every curve of it that the file numbers, named or not, for those who look for names:
/// one without is called by its number, curve_7.
Mesh load_all_named(const std::string& file, const GeoLimits& limits);

}  // namespace mortise
