// Meshes from bulk data of Nastran.
#pragma once

#include <string>

#include "mesh_files/set_mesh.hpp"

namespace mortise {

/// Reads GRID, triangles and quadrilaterals of 3, 4, 6 or 8 nodes (CTRIA3, CTRIAR, CQUAD4, CQUADR, CTRIA6, CQUAD8,
/// CPLSTN and CPLSTS) and lines (CBAR, CBEAM, CROD), with fields of 8 or 16 characters or between commas. Cells of a
/// property are a body, surface_7, its lines a curve, curve_7. Springs, masses and the like are left out with a note;
/// other entries are passed over. Throws InputError with file and line: other elements, other coordinate systems,
/// included files, nodes that are not there.
SetMesh read_bdf(const std::string& file);

}  // namespace mortise
