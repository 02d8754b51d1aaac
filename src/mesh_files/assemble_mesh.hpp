// From what a file holds to a mesh of bodies and boundaries.
#pragma once

#include "mesh/mesh.hpp"
#include "mesh_files/mesh_data.hpp"

namespace mortise {

/// Bodies are the named physical surfaces, boundaries the named physical curves, points the named physical points, by
/// tag; those without a name are called surface_3, curve_7 by their tags. Cells run counter-clockwise, with a note
/// where some did not; nodes and cells are renumbered, nodes of no cell left out. Throws InputError, naming file and
/// place: a group with the name of another, no body, a surface in no body or in two, a kind of element that is not
/// supported, a cell or an edge that is listed twice, a group without elements, a cell that is folded over others or
/// has no area, a body that leaves the plane z = 0, bodies in the plane x-z or y-z.
Mesh assemble_mesh(MeshData data);

}  // namespace mortise
