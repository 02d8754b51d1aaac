#include "error/spline.hpp"

#include <algorithm>

namespace mortise {

Knots clamped_knots(int degree, const std::vector<double>& breaks) {
  Knots knots{degree, {}};
  knots.t.insert(knots.t.end(), degree, breaks.front());
  knots.t.insert(knots.t.end(), breaks.begin(), breaks.end());
  knots.t.insert(knots.t.end(), degree, breaks.back());
  return knots;
}

SplineValues splines_at(const Knots& knots, double s) {
  const auto& t = knots.t;
  const auto inner = std::upper_bound(t.begin() + knots.degree + 1, t.end() - knots.degree - 1, s);
  const int k = int(inner - t.begin()) - 1;  // t[k] <= s < t[k + 1]
  SplineValues found{k - knots.degree, {1, 0, 0, 0}};
  for (int d = 1; d <= knots.degree; ++d) {
    double from_left = 0;
    for (int j = 0; j < d; ++j) {
      const double right = t[k + 1 + j], left = t[k + 1 + j - d];
      const double part = found.value[j] / (right - left);
      found.value[j] = from_left + (right - s) * part;
      from_left = (s - left) * part;
    }
    found.value[d] = from_left;
  }
  return found;
}

}  // namespace mortise
