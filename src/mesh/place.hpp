// Coordinates in messages.
#pragma once

#include <string>

#include "base/types.hpp"

namespace mortise {

/// "near (0.4, 0.3)": where to look in the mesh, six digits.
std::string near_point(const Vec2& point);

}  // namespace mortise
