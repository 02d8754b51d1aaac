// Vertices at which what is around a body goes on across a tie.
#pragma once

#include <map>

#include "mesh/side_table.hpp"

namespace mortise {

/// A vertex lies at a place of another curve where this part of an edge does not tell them apart.
inline constexpr double at_one_place = 0.05;

/// An edge of an outline, from one of its ends.
struct EdgeAtVertex {
  int vertex, other;  ///< nodes; -1: none
  auto operator<=>(const EdgeAtVertex&) const = default;
};

/// What is on the other side of a tied edge, there.
struct AcrossTie {
  EdgeAtVertex edge;  ///< none where the vertex lies within an edge of the other curve
  int body;
  double turn;  ///< what is there is here if it is turned by so much, radians: of cyclic ties
};

/// Of the ends of tied curves, where the other one has a vertex or goes on.
class TiedVertices {
 public:
  TiedVertices() = default;
  TiedVertices(const Mesh& mesh, const SideTable& table);
  /// nullptr: the edge is not tied up to its vertex.
  const AcrossTie* across(const EdgeAtVertex& edge) const;

 private:
  std::map<EdgeAtVertex, AcrossTie> across_;
};

}  // namespace mortise
