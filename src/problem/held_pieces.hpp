// Pieces of a body that nothing joins.
#pragma once

#include "base/constraints.hpp"
#include "mesh/mesh.hpp"

namespace mortise {

/// Of a body that falls into pieces, whose cells have no node in common, supports, ties or springs must hold each:
/// contact holds whole bodies only. Throws SceneError that names the body and a place on a piece that may move; the
/// first of the audit's `findings` ends it: probably meshes that were to be joined. Linear in the number of cells.
void require_held_pieces(const Mesh& mesh, const Constraints& constraints, const std::vector<std::string>& findings);

}  // namespace mortise
