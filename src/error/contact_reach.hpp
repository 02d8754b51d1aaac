// Up to which vertices of both curves of a pair contact is closed: by p, not by how far apart they are drawn.
#pragma once

#include "contact/singular_points.hpp"
#include "error/pressure_line.hpp"

namespace mortise {

/// A vertex of a pair at which contact was once found to be singular; its mesh may have been another.
struct FoundPoint {
  std::array<std::string, 2> between;  ///< the pair's curves, the multiplier side's first
  Vec2 position;
  bool swings = false;  ///< SingularPoint::is_swinging

  /// Whether it is the same place of the same pair.
  bool is(const FoundPoint& other) const;
};

/// On the multiplier side by p at the vertices and their neighbours, and where the sides overlap beside a vertex up to
/// it; on the opposite side by p where the normals meet it. Vertices at places of `found` count as reached from
/// both sides that face the other, but where the gap there is that of a border before them. `laws`: one a body; `u`:
/// displacements.
ContactReach contact_reach(const Mesh& mesh, const ContactPair& pair, const std::vector<ElasticLaw>& laws,
                           const PressureLine& line, const VecX& u, const std::vector<FoundPoint>& found);

/// The pair's names as FoundPoint has them.
std::array<std::string, 2> curve_names(const Mesh& mesh, const ContactPair& pair);

}  // namespace mortise
