// Free meshes of a drawn geometry with sizes by a function: the mesher of an accuracy loop. No gmsh header here.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gmsh/gmsh_process.hpp"
#include "mesh/mesh.hpp"
#include "model/geo_limits.hpp"

namespace mortise {

/// Meshes one .geo again and again: its geometry, its physical groups, its parameters, and nothing that it says of the
/// mesh. gmsh runs in the constructor and in mesh() only, in a child process each.
class FreeMesher {
 public:
  /// Throws InputError where load_mesh would before it meshes, and where there is no geometry: a .msh, or what
  /// read_free_geometry refuses. `limits`: of each call.
  FreeMesher(const std::string& file, const std::map<std::string, double>& parameters, const GeoLimits& limits = {});

  /// For the first sizes, before there is a mesh.
  const std::vector<DrawnCurve>& curves() const { return drawing_.curves; }

  /// 6-node triangles, or 8-node quadrilaterals with a few triangles between them, triangles alone where these
  /// quadrilaterals are inverted. The same sizes give the same mesh.
  /// `nodes`: about so many are expected, 0 if that is not known. gmsh 4.8 may go round for ever at some sizes: what
  /// takes far longer than earlier meshes did, node for node, is stopped, and other sizes are tried first. `size` is
  /// called in the child: what it throws comes through as run_in_child says, and what it writes to is not seen here.
  /// Throws std::domain_error where it is not > 0; InputError as load_mesh does, and where cells stay flat or inverted
  /// at 0.6 of the sizes too.
  Mesh mesh(const SizeAt& size, bool recombine = false, double nodes = 0);

 private:
  Mesh mesh_once(const SizeAt& size, bool recombine, double seconds);

  GmshProcess gmsh_;
  FreeDrawing drawing_;
  double limit_, slowest_ = 0;  // seconds; of all meshes so far, seconds a node
};

}  // namespace mortise
