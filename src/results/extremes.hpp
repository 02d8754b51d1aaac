// The largest stresses of a run, with their places.
#pragma once

#include <optional>

#include "results/contact_results.hpp"

namespace mortise {

struct Extreme {
  double value;
  int of;      ///< the body; of a pressure the pair
  int node;    ///< of the mesh
  Vec2 place;  ///< undeformed
};

struct Extremes {
  Extreme von_mises, principal_max, principal_min;  ///< of the stresses in result.vtu (StressField::points)
  std::optional<Extreme> pressure;                  ///< at the nodes of the multiplier sides; none without a pair
};

Extremes find_extremes(const Mesh& mesh, const BodyPoints& points, const StressField& stress,
                       const std::vector<ContactResults>& contacts);

}  // namespace mortise
