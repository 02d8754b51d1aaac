#include "fields/grid_module.hpp"

#include "base/module.hpp"

namespace mortise {

const GridModule& grid_module() {
  static const auto& module =
      load_module<GridModule>("mortise_grid", "values at points are read by VTK (Debian package mortise-vtk)");
  return module;
}

}  // namespace mortise
