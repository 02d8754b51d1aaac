#include "model/field_range.hpp"

#include <algorithm>

namespace mortise {

FieldRange::FieldRange(const Field& field)
    : expression_(ExpressionRange::of(field.words(), {"x", "y", "r", "theta", "s"})) {}

Interval FieldRange::operator()(const PlaceRange& places) const {
  const auto& [x, y, s] = places;
  const Interval r = rising(std::sqrt, power(x, {2, 2}) + power(y, {2, 2}));
  return (*expression_)({x, y, r, angle(y, x), s});
}

double scale_of(const Interval& values, const std::optional<Interval>& ranges) {
  constexpr double round_off = 1e-9, of_ranges = 1e-3;
  const double most = ranges ? of_ranges * (ranges->high - ranges->low) : 0;
  return std::max({values.high - values.low, most, round_off * values.magnitude(), std::numeric_limits<double>::min()});
}

}  // namespace mortise
