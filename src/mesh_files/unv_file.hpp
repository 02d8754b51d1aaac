// Meshes from universal files (I-DEAS; Salome, Siemens, gmsh).
#pragma once

#include <string>

#include "mesh_files/set_mesh.hpp"

namespace mortise {

/// Reads nodes (dataset 2411 or 781), triangles, quadrilaterals and lines of first and second order (2412) and named
/// groups of nodes and elements (2467, 2477, 2435, 2452, 752 and their kin) of a .unv; other datasets are passed over,
/// other elements too, with a note. Without groups that make bodies or curves the elements' physical properties do:
/// surface_7, curve_3. Throws InputError with file and line.
SetMesh read_unv(const std::string& file);

}  // namespace mortise
