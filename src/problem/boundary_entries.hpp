// The [[boundary]] entries with the curves and points that they lie on.
#pragma once

#include "fem/arc_length.hpp"
#include "mesh/side_table.hpp"
#include "model/boundary_spec.hpp"
#include "problem/scene_names.hpp"

namespace mortise {

/// A curve with its sides and, where the entry's fields ask for it, s along it.
struct NamedBoundary {
  int boundary;                 ///< of Mesh::boundaries
  std::vector<CellSide> sides;  ///< of loads, foundations and normals; in the order of the curve where s is asked for
  std::optional<ArcLength> s;

  double s_at(int node) const { return s ? s->at_node(node) : 0; }
};

struct BoundaryEntry {
  BoundarySpec spec;
  std::vector<NamedBoundary> curves;
  std::vector<int> points;  ///< of Mesh::points
};

/// One an entry of the scene. Throws SceneError where the mesh does not have the places that one names, or a point has
/// what acts along curves or the other way round.
std::vector<BoundaryEntry> boundary_entries(const std::vector<BoundarySpec>& specs, const Mesh& mesh,
                                            const SideTable& table, const SceneNames& names);

}  // namespace mortise
