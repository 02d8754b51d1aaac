// What rough surfaces, a gasket or a thin layer between the sides of a pair press with.
#pragma once

#include <string>
#include <vector>

#include "base/types.hpp"

namespace mortise {

/// p over what both sides overlap, d: growing, continuous, and p(-d) = -p(d). Any consistent units.
struct ContactLaw {
  /// Overlap and pressure, both > 0 and growing: p goes straight from (0, 0) through them, and on beyond the last.
  std::vector<Vec2> points;
  double exponent = 1;  ///< >= 1; of a single point: p = pressure (d / overlap)^exponent

  bool is_linear() const { return points.size() == 1 && exponent == 1; }
  double pressure(double d) const;
  double slope(double d) const;
  double overlap(double p) const;
  std::string words() const;

  bool operator==(const ContactLaw&) const = default;
};

}  // namespace mortise
