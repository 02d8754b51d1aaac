// Which way round the cells of a mesh file run.
#pragma once

#include "mesh/mesh.hpp"

namespace mortise {

/// Turns the cells of one surface, mesh.cells[first] to the last, counter-clockwise: a surface may be meshed upside
/// down as a whole (its curve loop ran clockwise), which is no error. How many ran the other way round than the rest.
/// Throws InputError, with coordinates, at a cell of no area, at one whose sides cross, and where the
/// surface is folded: two cells lie on the same side of an edge. Curved sides are not looked at here.
std::size_t orient_cells(Mesh& mesh, std::size_t first);

}  // namespace mortise
