#include "base/interval.hpp"

#include <algorithm>
#include <initializer_list>
#include <numbers>

namespace mortise {
namespace {

using std::numbers::pi;

Interval spanned(std::initializer_list<double> values) {
  Interval span{*values.begin(), *values.begin()};
  for (const double value : values) {
    if (std::isnan(value)) return Interval::everything();
    span = hull(span, {value, value});
  }
  return span;
}

// 0 times infinity is 0: the infinite end stands for numbers as large as may be.
double product(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }

bool is_whole(double value) { return value == std::floor(value) && std::abs(value) < 1e9; }

}  // namespace

Interval hull(const Interval& a, const Interval& b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }

Interval operator+(const Interval& a, const Interval& b) { return {a.low + b.low, a.high + b.high}; }

Interval operator-(const Interval& a) { return {-a.high, -a.low}; }

Interval operator-(const Interval& a, const Interval& b) { return a + -b; }

Interval operator*(const Interval& a, const Interval& b) {
  return spanned({product(a.low, b.low), product(a.low, b.high), product(a.high, b.low), product(a.high, b.high)});
}

Interval operator/(const Interval& a, const Interval& b) {
  if (b.contains(0)) return Interval::everything();
  return a * Interval{1 / b.high, 1 / b.low};
}

Interval power(const Interval& base, const Interval& exponent) {
  const double n = exponent.low;
  if (n == exponent.high && is_whole(n)) {
    if (n < 0) return Interval{1, 1} / power(base, {-n, -n});
    const double low = std::pow(base.low, n), high = std::pow(base.high, n);
    if (std::fmod(n, 2) != 0) return {low, high};
    return {n > 0 && base.contains(0) ? 0 : std::min(low, high), std::max(low, high)};
  }
  if (base.high < 0) return Interval::everything();
  const double least = std::max(base.low, 0.0);
  return spanned({std::pow(least, exponent.low), std::pow(least, exponent.high), std::pow(base.high, exponent.low),
                  std::pow(base.high, exponent.high)});
}

Interval smaller(const Interval& a, const Interval& b) { return {std::min(a.low, b.low), std::min(a.high, b.high)}; }

Interval larger(const Interval& a, const Interval& b) { return {std::max(a.low, b.low), std::max(a.high, b.high)}; }

Interval absolute(const Interval& a) {
  if (a.contains(0)) return {0, a.magnitude()};
  return spanned({std::abs(a.low), std::abs(a.high)});
}

Interval cosine(const Interval& a) {
  if (!std::isfinite(a.low) || !std::isfinite(a.high)) return {-1, 1};
  Interval result = spanned({std::cos(a.low), std::cos(a.high)});
  const auto reaches = [&](double phase) {  // whether phase + 2 pi k lies in a
    return std::floor((a.high - phase) / (2 * pi)) >= std::ceil((a.low - phase) / (2 * pi));
  };
  if (reaches(0)) result.high = 1;
  if (reaches(pi)) result.low = -1;
  return result;
}

Interval tangent(const Interval& a) {
  const double branch = std::floor((a.low + pi / 2) / pi);
  if (!(a.high < pi / 2 + branch * pi)) return Interval::everything();
  return {std::tan(a.low), std::tan(a.high)};
}

Interval angle(const Interval& y, const Interval& x) {
  if (x.low <= 0 && y.contains(0)) return {-pi, pi};  // the box has the origin or the cut
  return spanned(
      {std::atan2(y.low, x.low), std::atan2(y.low, x.high), std::atan2(y.high, x.low), std::atan2(y.high, x.high)});
}

Interval rising(double (*function)(double), const Interval& a, double least, double most) {
  if (a.high < least || a.low > most) return Interval::everything();
  return spanned({function(std::max(a.low, least)), function(std::min(a.high, most))});
}

}  // namespace mortise
