// The cell in which a place lies.
#pragma once

#include <optional>

#include "fem/elements.hpp"

namespace mortise {

struct CellPlace {
  int cell;
  Vec2 xi;          ///< reference coordinates
  double distance;  ///< from the place to the cell's own there, length: 0 inside
};

/// The cell of a body that has x, or, where the boundary's edges miss it, the one that comes nearest; nothing where x
/// is further from all than a tenth of their size.
std::optional<CellPlace> locate(const Mesh& mesh, int body, const Vec2& x);

}  // namespace mortise
