#include "model/field_range.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mortise {

FieldRange::FieldRange(const Field& field)
    : expression_(ExpressionRange::of(field.words(), {"x", "y", "r", "theta", "s"})) {}

namespace {

Interval radius(const Interval& x, const Interval& y) { return rising(std::sqrt, power(x, {2, 2}) + power(y, {2, 2})); }

}  // namespace

Interval FieldRange::operator()(const PlaceRange& places) const {
  const auto& [x, y, s] = places;
  return (*expression_)({x, y, radius(x, y), angle(y, x), s});
}

Interval FieldRange::along(const PathRange& path) const {
  const auto& [x, y, s] = path.box;
  const Interval r = radius(x, y), theta = angle(y, x), box = (*expression_)({x, y, r, theta, s});
  if (!(r.low > 0) || theta.high - theta.low > std::numbers::pi) return box;  // theta jumps
  const std::vector<Interval> rates{path.dx, path.dy, (x * path.dx + y * path.dy) / r,
                                    (x * path.dy - y * path.dx) / (r * r), radius(path.dx, path.dy)};
  const Vec2& at = path.middle;
  const Interval found = expression_->along(
      {x, y, r, theta, s}, {at.x(), at.y(), at.norm(), std::atan2(at.y(), at.x()), path.s}, rates, path.half);
  return {std::max(box.low, found.low), std::min(box.high, found.high)};
}

double scale_of(const Interval& values, const std::optional<Interval>& ranges) {
  constexpr double round_off = 1e-9, of_ranges = 1e-3;
  const double most = ranges ? of_ranges * (ranges->high - ranges->low) : 0;
  return std::max({values.high - values.low, most, round_off * values.magnitude(), std::numeric_limits<double>::min()});
}

}  // namespace mortise
