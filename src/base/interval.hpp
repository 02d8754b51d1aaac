// Interval arithmetic: the values that a function may take between the places at which it is evaluated.
#pragma once

#include <cmath>
#include <limits>

namespace mortise {

/// All numbers from `low` to `high`, both included; either may be infinite.
struct Interval {
  double low = 0, high = 0;

  static Interval everything() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  bool contains(double value) const { return low <= value && value <= high; }
  double magnitude() const { return std::fmax(std::abs(low), std::abs(high)); }
  bool operator==(const Interval&) const = default;
};

/// The smallest interval that contains both.
Interval hull(const Interval& a, const Interval& b);

/// What the operation makes of all numbers of its operands (Moore, Kearfott & Cloud 2009, chapter 2). Rounding is not
/// directed: bounds are right to some units in the last place. Numbers for which a function is not defined are left
/// out; where none remain, and at poles, the result is everything.
Interval operator+(const Interval& a, const Interval& b);
Interval operator-(const Interval& a, const Interval& b);
Interval operator-(const Interval& a);
Interval operator*(const Interval& a, const Interval& b);
Interval operator/(const Interval& a, const Interval& b);
Interval power(const Interval& base, const Interval& exponent);
Interval smaller(const Interval& a, const Interval& b);
Interval larger(const Interval& a, const Interval& b);
Interval absolute(const Interval& a);
Interval cosine(const Interval& a);
Interval tangent(const Interval& a);
Interval angle(const Interval& y, const Interval& x);  ///< atan2

/// The range of a function that rises on its domain [least, most].
Interval rising(double (*function)(double), const Interval& a, double least = -std::numeric_limits<double>::infinity(),
                double most = std::numeric_limits<double>::infinity());

}  // namespace mortise
