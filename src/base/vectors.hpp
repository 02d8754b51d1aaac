// Products and angles of vectors in the plane.
#pragma once

#include <cmath>

#include "base/types.hpp"

namespace mortise {

/// a_1 b_2 - a_2 b_1: positive where b lies on the left of a.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Between two directions, 0 ... pi.
inline double angle_between(const Vec2& a, const Vec2& b) { return std::abs(std::atan2(cross(a, b), a.dot(b))); }

}  // namespace mortise
