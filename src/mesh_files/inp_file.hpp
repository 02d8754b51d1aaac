// Meshes from decks of Abaqus and CalculiX.
#pragma once

#include <string>

#include "mesh_files/set_mesh.hpp"

namespace mortise {

/// Reads nodes, plane elements and sets of a .inp: *NODE, *ELEMENT (CPS, CPE and CAX of 3, 4, 6 or 8 nodes), *NSET,
/// *ELSET, *SURFACE, and which sets *SOLID SECTION makes bodies. Materials, steps and loads are passed over, springs
/// and other elements without area too, with a note. Throws InputError with file and line: a kind of element that is
/// not supported, nodes and elements that are twice there or not at all, sets that are not there, several parts, what
/// makes nodes by rules, included files.
SetMesh read_inp(const std::string& file);

}  // namespace mortise
