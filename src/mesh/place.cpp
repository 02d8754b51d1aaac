#include "mesh/place.hpp"

#include <array>
#include <cstdio>

namespace mortise {

std::string near_point(const Vec2& point) {
  std::array<char, 80> text{};
  // Adding zero turns -0 into 0.
  std::snprintf(text.data(), text.size(), "near (%.6g, %.6g)", point.x() + 0.0, point.y() + 0.0);
  return text.data();
}

}  // namespace mortise
