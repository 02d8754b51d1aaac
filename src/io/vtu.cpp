#include "io/vtu.hpp"

#include "io/module.hpp"
#include "io/vtk_module.hpp"

namespace mortise {

void write_vtu(const std::filesystem::path& path, const VtuGrid& grid) {
  static const auto& vtk = load_module<VtkModule>("mortise_vtk", "a .vtu is written by VTK");
  vtk.write(path, grid);
}

}  // namespace mortise
