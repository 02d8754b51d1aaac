// A geometry without what its .geo says of the mesh. No gmsh header here.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gmsh/gmsh_session.hpp"
#include "mesh_files/mesh_data.hpp"

namespace mortise {

/// Geometry that gmsh meshes again and again with sizes of our own.
struct FreeGeometry {
  std::string file;  ///< where it came from
  std::map<std::string, double> parameters;
  std::string text;                   ///< the geometry as a .geo; empty where only `file` has it (OpenCASCADE)
  std::vector<PhysicalGroup> groups;  ///< dimensions 1 and 2
  Vec2 shift = Vec2::Zero();          ///< by which `text` is moved from where it is drawn: to the origin
};

/// Reads a .geo. Transfinite, Recombine, Periodic, Compound, fields and all mesh options are dropped, as is a mesh that
/// the .geo made or merged. Throws InputError as GmshSession::read does, and where there is no geometry: no surface, a
/// physical surface that is a mesh itself, or surfaces of both of gmsh's kernels.
FreeGeometry read_free_geometry(GmshSession& session, const std::string& file,
                                const std::map<std::string, double>& parameters);

/// Opens it in a session that has just started, unmeshed, with gmsh's own options.
void open_free_geometry(GmshSession& session, const FreeGeometry& geometry);

}  // namespace mortise
