// p against the normal stress that the bodies' displacements give: how far the discretisation can be trusted.
#pragma once

#include <optional>

#include "contact/singular_points.hpp"
#include "results/contact_results.hpp"

namespace mortise {

struct StressComparison {
  /// What |p + sigma_n| stays below on 90 % of the compared length, over the mean |p| there; the larger of both sides.
  double difference;
  std::string curve;  ///< whose sigma_n differs most
  Vec2 position;      ///< where
};

/// Left out are nodes that face nothing or have parted, and those within two edges of a singular point: the exact
/// stress has no limit there, and no mesh shows it. Nothing where no node is left, or where no p is above `negligible`
/// (stress): p is round-off there.
std::optional<StressComparison> compare_with_stress(const ContactResults& contact,
                                                    const std::vector<SingularPoint>& singular, double negligible);

}  // namespace mortise
