// The cells in which the places of [[probe]] entries lie.
#pragma once

#include "fem/locate.hpp"

namespace mortise {

struct Scene;

struct ProbePlace {
  int probe;        ///< of Scene::probes
  std::string key;  ///< of its entry
  Vec2 x;           ///< undeformed
  double s;         ///< from the start of a line; NaN of a point
  double angle;     ///< of the axes of the stress, radians counter-clockwise
  CellPlace in;
};

/// Throws SceneError where a place lies in no body or, none being named, on the boundary of two.
std::vector<ProbePlace> locate_probes(const Scene& scene, const Mesh& mesh);

}  // namespace mortise
