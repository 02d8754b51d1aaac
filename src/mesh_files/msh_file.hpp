// Meshes in gmsh's own format, read without gmsh.
#pragma once

#include <string>

#include "mesh_files/mesh_data.hpp"

namespace mortise {

/// Reads a .msh: format 2.2 or 4.1 (gmsh's reference manual, "MSH file format"), text or binary of the byte order of
/// this machine. Sections that are not needed here ($Periodic, $NodeData, comments and others) are passed over.
/// Throws InputError with file, line (or byte) and section: sections that are missing, twice or not closed; more or
/// fewer entries than a section says; tags that are not > 0, not unique or not known; unknown kinds of elements;
/// numbers that are not finite; a partitioned mesh. Needs no more memory than the file's size makes plausible.
MeshData read_msh(const std::string& file);

}  // namespace mortise
