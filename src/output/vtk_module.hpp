// The calls of VTK, in a shared object of their own that is loaded when the first file is written. No VTK header here.
#pragma once

#include <filesystem>

namespace mortise {

struct VtuGrid;

struct VtkModule {
  void (*write)(const std::filesystem::path& path, const VtuGrid& grid);  ///< write_vtu
};

}  // namespace mortise
