// One free mesh of a geometry, by gmsh. No gmsh header here.
#pragma once

#include "gmsh/gmsh_module.hpp"

namespace mortise {

/// GmshModule's.
MeshData mesh_freely(const FreeGeometry& geometry, const SizeAt& size, bool recombine, ForbiddenBy forbidden);

}  // namespace mortise
