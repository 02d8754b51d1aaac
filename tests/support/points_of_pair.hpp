// Singular points of one pair of curves by itself.
#pragma once

#include "contact/singular_points.hpp"

namespace mortise::test {

inline ContactReach reached_everywhere(const Curve& first, const Curve& second) {
  return {std::vector<Reach>(first.edges.size() + 1, {true, true}),
          std::vector<Reach>(second.edges.size() + 1, {true, true})};
}

inline std::vector<SingularPoint> points_of_pair(const Surroundings& around, const Curve& first, const Curve& second,
                                                 const ContactReach& reach) {
  return singular_points({contact_places(around, first, second, reach)}, around.tips)[0];
}

}  // namespace mortise::test
