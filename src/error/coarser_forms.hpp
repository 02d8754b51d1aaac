// What p* may be off by along the line, as meshes with fewer vertices tell it. docs/theory.md, section 14.
#pragma once

#include <vector>

#include "error/pressure_form.hpp"

namespace mortise {

/// p* as it would be of a mesh with every second vertex of the piece, every fourth, every eighth, as far as there are
/// enough for one: of its moments, which are sums of the piece's.
std::vector<PressureForm> coarser_forms(const LoadedPiece& piece);

/// p* is off by no more than this part, at most 1, of what p* of every other vertex differs by from it. `squares`: of
/// the norms of what p* of one mesh and of the next differ by, the finest first (docs/theory.md eq. 48d).
double part_left(const std::vector<double>& squares);

}  // namespace mortise
