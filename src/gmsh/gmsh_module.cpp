#include "gmsh/gmsh_module.hpp"

#include "base/module.hpp"

namespace mortise {

const GmshModule& gmsh_module() {
  static const auto& module =
      load_module<GmshModule>("mortise_gmsh", "a .geo is meshed by gmsh (Debian package mortise-gmsh)");
  return module;
}

}  // namespace mortise
