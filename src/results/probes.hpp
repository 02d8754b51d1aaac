// The solution at places that the scene asks for.
#pragma once

#include "error/place_errors.hpp"
#include "fem/stress.hpp"
#include "problem/problem.hpp"

namespace mortise {

struct ProbeValue {
  ProbePlace place;
  Vec2 u;       ///< along x and y
  Vec4 stress;  ///< recovered by patches (fem/patch_recovery.hpp), in the axes of the probe
  double von_mises;
  double spread;  ///< largest difference of a component from the averages in result.vtu (StressField::points)
  std::optional<PlaceError> error;  ///< where errors were estimated
};

/// At all of the problem's places. `averages`: recover_stress.
std::vector<ProbeValue> probe_values(const Problem& problem, const VecX& u, const StressField& averages);

/// The numbers of a place by their columns in probes.csv, but for that of its [[probe]].
std::vector<std::pair<const char*, double>> probe_figures(const ProbeValue& value);

/// The places of each [[probe]].
std::vector<ProbedPlaces> probed_places(const std::vector<ProbeValue>& values);

}  // namespace mortise
