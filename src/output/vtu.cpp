#include "output/vtu.hpp"

#include <cstdlib>

#include "base/module.hpp"
#include "output/vtk_module.hpp"

namespace mortise {
namespace {

const VtkModule& load_vtk() {
  setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 0);  // its threads take longer to start than a file takes to write
  return load_module<VtkModule>("mortise_vtk", "a .vtu is written by VTK");
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const VtuGrid& grid) {
  static const VtkModule& vtk = load_vtk();
  vtk.write(path, grid);
}

}  // namespace mortise
