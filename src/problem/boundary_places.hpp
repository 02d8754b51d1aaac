// The curves and points that a [[boundary]] entry lies on.
#pragma once

#include "fem/arc_length.hpp"
#include "problem/scene_names.hpp"
#include "scene/scene.hpp"

namespace mortise {

/// A curve with its sides and, where the entry's fields ask for it, s along it.
struct NamedBoundary {
  int boundary;                 ///< of Mesh::boundaries
  std::vector<CellSide> sides;  ///< of loads, foundations and normals; in the order of the curve where s is asked for
  std::optional<ArcLength> s;

  double s_at(int node) const { return s ? s->at_node(node) : 0; }
};

/// The fields of an entry: of loads, foundations and displacements.
std::vector<const Field*> fields_of(const BoundarySpec& spec);

struct Places {
  std::vector<NamedBoundary> boundaries;
  std::vector<const NamedPoint*> points;
};

/// Throws SceneError where the mesh does not have them, or a point has what acts along curves or the other way round.
Places places_of(const Mesh& mesh, const SideTable& table, const SceneNames& names, const BoundarySpec& spec);

}  // namespace mortise
