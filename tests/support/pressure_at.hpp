// The pressure between nodes of contact.
#pragma once

#include <gtest/gtest.h>

#include "results/contact_results.hpp"

namespace mortise::test {

/// p at x1 = x, stress: linear between the two nodes on either side. Fails where there are none.
inline double pressure_at(const std::vector<ContactNode>& nodes, double x) {
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const double a = nodes[i].position.x(), b = nodes[i + 1].position.x();
    if ((a - x) * (b - x) <= 0) return nodes[i].p + (x - a) / (b - a) * (nodes[i + 1].p - nodes[i].p);
  }
  ADD_FAILURE() << x;
  return 0;
}

}  // namespace mortise::test
