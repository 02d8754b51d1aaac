// Which way round the cells of a mesh file run.
#pragma once

#include "mesh/mesh.hpp"

namespace mortise {

/// Turns the cells of one surface, mesh.cells[first] to the last, counter-clockwise: a surface may be meshed upside
/// down as a whole (its curve loop ran clockwise), which is no error.
/// Throws InputError, with coordinates, at a cell of no area, at one whose sides cross, and where a surface has cells
/// of both orientations (it is folded). Curved sides are not looked at here.
void orient_cells(Mesh& mesh, std::size_t first);

}  // namespace mortise
