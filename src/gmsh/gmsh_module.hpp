// The calls of gmsh, in a shared object of their own that is loaded when the first .geo is meshed: libgmsh brings some
// ninety libraries with it, which take longer to load than a small scene to solve. No gmsh header here.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/module.hpp"
#include "gmsh/free_geometry.hpp"
#include "gmsh/gmsh_curves.hpp"
#include "gmsh/sandbox.hpp"
#include "mesh_files/mesh_data.hpp"

namespace mortise {

/// Wanted length of the edges at a place, > 0.
using SizeAt = std::function<double(const Vec2& x)>;

/// A geometry to be meshed freely, and its curves.
struct FreeDrawing {
  FreeGeometry geometry;
  std::vector<DrawnCurve> curves;
};

/// The module's functions, for a child process (GmshProcess): gmsh changes the process that it runs in. All throw
/// InputError that names the file and gmsh's own message. `forbidden`: null where a .geo may run programs and write
/// files.
struct GmshModule {
  /// Meshes a .geo with these values of its DefineConstant names.
  MeshData (*mesh_geo)(const std::string& file, const std::map<std::string, double>& parameters, ForbiddenBy forbidden);
  /// read_free_geometry and drawn_curves.
  FreeDrawing (*read_drawing)(const std::string& file, const std::map<std::string, double>& parameters,
                              ForbiddenBy forbidden);
  /// Meshes the geometry with these sizes: see FreeMesher.
  MeshData (*mesh_freely)(const FreeGeometry& geometry, const SizeAt& size, bool recombine, ForbiddenBy forbidden);
  /// The files that the module and libgmsh were loaded from.
  std::vector<std::string> (*files)();
};

/// Loads it at the first call, from where the program's RPATH says. Throws InputError with the loader's words if it or
/// a library that it needs is not there.
inline const GmshModule& gmsh_module() {
  static const auto& module =
      load_module<GmshModule>("mortise_gmsh", "a .geo is meshed by gmsh (Debian package mortise-gmsh)");
  return module;
}

}  // namespace mortise
