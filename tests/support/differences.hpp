// How far two runs are apart.
#pragma once

#include <algorithm>

#include "app/solve_scene.hpp"

namespace mortise::test {

/// Largest difference of the pressures over the largest pressure of `b`.
inline double pressure_difference(const Results& a, const Results& b) {
  double difference = 0, size = 0;
  for (std::size_t k = 0; k < a.contacts.size(); ++k) {
    difference = std::max(difference, largest_entry(a.contacts[k].pressure - b.contacts[k].pressure));
    size = std::max(size, largest_entry(b.contacts[k].pressure));
  }
  return difference / size;
}

}  // namespace mortise::test
