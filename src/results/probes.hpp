// The solution at places that the scene asks for.
#pragma once

#include "error/place_errors.hpp"
#include "fem/stress.hpp"
#include "scene/scene.hpp"

namespace mortise {

struct ProbePlace {
  int probe;     ///< of Scene::probes
  Vec2 x;        ///< undeformed
  double s;      ///< from the start of a line; NaN of a point
  double angle;  ///< of the axes of the stress, radians counter-clockwise
  CellPlace in;
};

struct ProbeValue {
  ProbePlace place;
  Vec2 u;       ///< along x and y
  Vec4 stress;  ///< recovered by patches (fem/patch_recovery.hpp), in the axes of the probe
  double von_mises;
  double spread;  ///< largest difference of a component from the averages in result.vtu (StressField::points)
  std::optional<PlaceError> error;  ///< where errors were estimated
};

/// Throws SceneError where a place lies in no body or, none being named, on the boundary of two.
std::vector<ProbePlace> locate_probes(const Scene& scene, const Mesh& mesh);

std::vector<ProbeValue> probe_values(const Mesh& mesh, const BodyPoints& points, const std::vector<ElasticLaw>& laws,
                                     const VecX& u, const StressField& averages, const std::vector<ProbePlace>& places);

/// Of each [[probe]] its places.
std::vector<ProbedPlaces> probed_places(const std::vector<ProbeValue>& values);

}  // namespace mortise
