// The solution at places that the scene asks for.
#pragma once

#include "error/place_errors.hpp"
#include "fem/stress.hpp"
#include "problem/probe_places.hpp"

namespace mortise {

struct ProbeValue {
  ProbePlace place;
  Vec2 u;       ///< along x and y
  Vec4 stress;  ///< recovered by patches (fem/patch_recovery.hpp), in the axes of the probe
  double von_mises;
  double spread;  ///< largest difference of a component from the averages in result.vtu (StressField::points)
  std::optional<PlaceError> error;  ///< where errors were estimated
};

std::vector<ProbeValue> probe_values(const Mesh& mesh, const BodyPoints& points, const std::vector<ElasticLaw>& laws,
                                     const VecX& u, const StressField& averages, const std::vector<ProbePlace>& places);

/// The places of each [[probe]].
std::vector<ProbedPlaces> probed_places(const std::vector<ProbeValue>& values);

}  // namespace mortise
