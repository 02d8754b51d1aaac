// Meshes from files: a .geo is meshed by gmsh in process, a .msh is read by ourselves.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/geo_limits.hpp"
#include "mesh/mesh.hpp"

namespace mortise {

/// What can be told before `file` is read. Throws InputError naming it: no .geo or .msh, no such file, parameters given
/// to a .msh, what check_geo refuses.
void check_mesh_file(const std::string& file, const std::map<std::string, double>& parameters, const GeoLimits& limits);

/// The mesh of `file`; `parameters` set DefineConstant names of a .geo, `limits` what it may do.
/// Bodies are the named physical surfaces, boundaries the named physical curves; nodes of no body are left out.
/// Throws InputError naming the file and the place: no such file, gmsh's own message, a parameter that the .geo does
/// not define or that is outside the range it gives, parameters given to a .msh, what read_msh and assemble_mesh
/// refuse. Where gmsh crashes, ends the process or takes too long, the process ends with one line and exit status 1
/// (GmshGuard).
Mesh load_mesh(const std::string& file, const std::map<std::string, double>& parameters, const GeoLimits& limits = {});

/// Throws InputError where write_msh could not write `output`, or should not: it is one of `inputs` or no .msh.
void check_msh_target(const std::string& output, const std::vector<std::string>& inputs);

/// Meshes `file` and writes the mesh as `output` (.msh, format 4.1): whole, read back once, or not at all.
/// Throws as load_mesh and check_msh_target do.
void write_msh(const std::string& file, const std::map<std::string, double>& parameters, const std::string& output,
               const GeoLimits& limits = {});

class GmshSession;
class GmshGuard;

/// Writes the mesh that gmsh has open, of which `mesh` is what it read as, likewise.
void write_open_mesh(GmshSession& session, GmshGuard& guard, const Mesh& mesh, const std::string& output);

}  // namespace mortise
