// How far two runs are apart.
#pragma once

#include <algorithm>

#include "app/solve_scene.hpp"

namespace mortise::test {

/// Largest difference of the pressures over the largest pressure of `b`; 0 where neither has any.
inline double pressure_difference(const Results& a, const Results& b) {
  double found = 0, size = 0;
  for (std::size_t k = 0; k < a.recovery.contacts.size(); ++k) {
    found = largest(found, largest_entry(a.recovery.contacts[k].pressure - b.recovery.contacts[k].pressure));
    size = largest(size, largest_entry(b.recovery.contacts[k].pressure));
  }
  return fraction(found, size);
}

}  // namespace mortise::test
