// A mesh as a file for gmsh, and for ourselves.
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace mortise {

/// Throws InputError where write_msh could not write `output`, or should not: it is one of `inputs` (a .geo with all
/// that it reads) or no .msh.
void check_msh_target(const std::string& output, const std::vector<std::string>& inputs);

/// Writes a .msh, format 4.1, text, numbers exact to the last digit: whole, read back once, or not at all. A surface a
/// body, a curve a boundary (or the edges that several have in common), tags in their order from 1; a point a node with
/// a name. Throws InputError.
void write_msh(const Mesh& mesh, const std::string& output);

}  // namespace mortise
