#include "output/vtu.hpp"

#include <cstdlib>

#include "base/errors.hpp"
#include "base/module.hpp"
#include "output/vtk_module.hpp"

namespace mortise {
namespace {

const VtkModule& load_vtk() {
  setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 0);  // its threads take longer to start than a file takes to write
  return load_module<VtkModule>("mortise_vtk", "a .vtu is written by VTK (Debian package mortise-vtk)");
}

const VtkModule& vtk() {
  static const VtkModule& module = load_vtk();
  return module;
}

}  // namespace

std::optional<std::string> why_no_vtu() try {
  vtk();
  return {};
} catch (const InputError& error) {
  return error.what();
}

void write_vtu(const std::filesystem::path& path, const VtuGrid& grid) { vtk().write(path, grid); }

}  // namespace mortise
