// B-splines on knots of any distance.
#pragma once

#include <array>
#include <vector>

namespace mortise {

/// Clamped at both ends: the first and the last knot stand there degree + 1 times.
struct Knots {
  int degree = 3;  ///< at most 3
  std::vector<double> t;

  int count() const { return int(t.size()) - degree - 1; }  ///< of splines
};

/// The knots of `degree` with these breaks: both ends and what lies between, ascending.
Knots clamped_knots(int degree, const std::vector<double>& breaks);

/// The splines that are not zero at a place: numbers first ... first + degree.
struct SplineValues {
  int first = 0;
  std::array<double, 4> value{};
};

/// At s, within the knots (Cox & de Boor's recursion: de Boor 2001, chapter X). They sum to 1.
SplineValues splines_at(const Knots& knots, double s);

}  // namespace mortise
