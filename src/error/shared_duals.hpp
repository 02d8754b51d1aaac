// Dual solutions that serve windows far from each other at once, so that their number does not grow with the pairs.
#pragma once

#include "mesh/mesh.hpp"

namespace mortise {

struct SharedDuals {
  std::vector<int> dual;   ///< of each window
  int count = 0;           ///< of the duals
  Eigen::MatrixXi window;  ///< cells x duals: the window, of those that share the dual, that is nearest to the cell
};

/// One dual a window where there are at most `most`; else `most`, shared by windows as far from each other as may be:
/// one by one, each window takes the dual whose windows so far are farthest away. What a dual says in a cell counts for
/// the window nearest to the cell: stresses of a window's dual fall with the square of the distance from it, their
/// error faster. `centres`: of the windows.
SharedDuals share_duals(const Mesh& mesh, const std::vector<Vec2>& centres, int most);

}  // namespace mortise
