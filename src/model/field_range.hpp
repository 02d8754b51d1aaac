// Bounds on a field between the places at which it is evaluated.
#pragma once

#include "model/expression_range.hpp"
#include "model/field.hpp"

namespace mortise {

/// The box of a set of places, and their arc lengths.
struct PlaceRange {
  Interval x, y, s;
};

/// Places on a piece of a path, by a parameter that goes from -half to half about its middle.
struct PathRange {
  PlaceRange box;
  Vec2 middle;
  double s;         ///< arc length there
  Interval dx, dy;  ///< derivatives by the parameter
  double half;
};

/// The ranges of a field.
class FieldRange {
 public:
  explicit FieldRange(const Field& field);

  /// Whether they are known: not of an expression that names a function of a file.
  bool known() const { return bool(expression_); }
  /// An interval that contains all values on a set of places. Expects known().
  Interval operator()(const PlaceRange& places) const;
  /// Likewise on a path, along which what varies in the box may be constant: r on a circle, a height on a level.
  Interval along(const PathRange& path) const;

 private:
  std::optional<ExpressionRange> expression_;
};

/// By how much a field varies: the difference of the values seen; a thousandth of that of its ranges if this is more
/// (what is narrow may not have been seen yet); and no round-off. > 0.
double scale_of(const Interval& values, const std::optional<Interval>& ranges);

}  // namespace mortise
