// The cell in which a place lies.
#pragma once

#include <optional>

#include "fem/elements.hpp"
#include "mesh/box_index.hpp"

namespace mortise {

struct CellPlace {
  int cell;
  Vec2 xi;          ///< reference coordinates
  double distance;  ///< from the place to the cell's own there, length: 0 inside
};

/// The cell of a body that has x, or, where the boundary's edges miss it, the one that comes nearest; nothing where x
/// is further from all than a tenth of their size.
std::optional<CellPlace> locate(const Mesh& mesh, int body, const Vec2& x);

/// The same of many places, in all bodies.
class CellFinder {
 public:
  explicit CellFinder(const Mesh& mesh);

  /// The cell of each body that has x or comes nearest, ordered by distance.
  std::vector<CellPlace> around(const Vec2& x) const;

  /// The first cell of any body that has x, to round-off, or the one that comes nearest.
  std::optional<CellPlace> nearest(const Vec2& x) const;

 private:
  const Mesh& mesh_;
  BoxIndex cells_;
};

/// Diagonal of the box round a cell.
double cell_size(const Mesh& mesh, int cell);

/// Of the polygon of its corners.
double cell_area(const Mesh& mesh, int cell);

}  // namespace mortise
