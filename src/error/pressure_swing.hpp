// How far the pressure swings from node to node: what the slopes of a smooth function do not show.
#pragma once

#include "error/pressure_line.hpp"

namespace mortise {

/// The nodes that have multipliers, along the line: vertex i is node `step` * i.
struct PressureNodes {
  int step = 1;  ///< 2 where the middles of edges have some too
  VecX s, p;     ///< arc length from the first one; pressure
  /// Whether p is smooth beside the node as far as is known: it carries pressure, faces the other side, and is not left
  /// out for a singular point.
  std::vector<char> smooth;
  bool closed = false;  ///< the last node is the first one
};

/// The nodes on either side of one that swings() fits with it.
inline constexpr int swing_reach = 4;

/// `excluded`: flags of the line's vertices.
PressureNodes pressure_nodes(const PressureLine& line, const std::vector<char>& excluded);

/// Of each node p less the cubic polynomial in s that fits it and the nodes around it best, nine together, in least
/// squares; 0 where not so many as a cubic needs lie between places where p is not smooth. Nine nodes smooth what
/// swings within four edges, and a cubic over them follows a p that the mesh resolves.
VecX swings(const PressureNodes& nodes);

/// Root mean square over the nine nodes about each vertex of a figure of the nodes, those that are NaN or not smooth
/// left out: infinity where all are.
VecX means_at_vertices(const PressureNodes& nodes, const VecX& figures);

/// Gives the local error the swing `errors` (stress, one a vertex).
void set_swing(const VecX& errors, const PressureLine& line, LineError& local);

}  // namespace mortise
