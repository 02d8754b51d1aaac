// Files read and triangulated by VTK, in a shared object of its own that is loaded for the first field that comes
// from a file. No VTK header here.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "base/module.hpp"
#include "base/types.hpp"

namespace mortise {

struct VtuGrid;

struct GridModule {
  /// Points, plane cells (`body` 0; lines and points are left out) and the array of that name at the points of a .vtu.
  /// Throws InputError where it cannot be read or has no such array, leaves the plane z = 0 or has cells that Mesh does
  /// not know. For a child process: VTK may crash on a damaged file.
  VtuGrid (*read)(const std::filesystem::path& path, const std::string& array);
  /// Delaunay's triangles of points that all differ; none of points on one line.
  std::vector<std::array<int, 3>> (*triangulate)(const Points& points);
};

/// Loads it at the first call. Throws InputError with the loader's words.
inline const GridModule& grid_module() {
  static const auto& module =
      load_module<GridModule>("mortise_grid", "values at points are read by VTK (Debian package mortise-vtk)");
  return module;
}

}  // namespace mortise
