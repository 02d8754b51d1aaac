// The sides of all cells by their nodes.
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace mortise {

/// A cell's side as one of its two corners sees it.
struct SideAtNode {
  int other;    ///< the corner at its other end
  bool starts;  ///< counter-clockwise round its cell the side runs from here to the other end
  CellSide side;
};

/// Made once for a mesh, in linear time; then a side is found by its ends without a look at other cells.
class SideTable {
 public:
  explicit SideTable(const Mesh& mesh);
  /// The sides that start or end at a node, by cell.
  std::span<const SideAtNode> at(int node) const {
    return {sides_.data() + first_[node], std::size_t(first_[node + 1] - first_[node])};
  }

 private:
  std::vector<int> first_;
  std::vector<SideAtNode> sides_;  // those of node i are first_[i] .. first_[i + 1] - 1
};

/// For each edge of a boundary, the one cell side it lies on.
/// Throws InputError, with coordinates, where an edge belongs to no cell or to two (it is not on the boundary).
std::vector<CellSide> sides_of(const Mesh& mesh, const Boundary& boundary, const SideTable& table);

/// The same of a single boundary.
std::vector<CellSide> sides_of(const Mesh& mesh, const Boundary& boundary);

}  // namespace mortise
