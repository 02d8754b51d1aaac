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
};

Extremes find_extremes(const Mesh& mesh, const BodyPoints& points, const StressField& stress);

/// The largest ContactResults::p_max of all pairs, as it stands now (p* where it is known); none without a pair.
std::optional<Extreme> largest_pressure(const std::vector<ContactResults>& contacts);

}  // namespace mortise
