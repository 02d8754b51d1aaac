#include "reference_pressure.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace mortise::chart {

Pressure reference_pressure(const std::string& path) {
  std::ifstream file(path);
  std::string header;
  std::getline(file, header);
  std::vector<double> xs, ps;
  double x = 0, p = 0;
  for (char comma = 0; file >> x >> comma >> p;) {
    if (!xs.empty() && x <= xs.back()) throw std::runtime_error(path + ": x does not increase at " + std::to_string(x));
    xs.push_back(x);
    ps.push_back(p);
  }
  if (header != "x,p" || xs.size() < 2) throw std::runtime_error(path + ": cannot be read; expected a CSV of x,p");
  return [xs = std::move(xs), ps = std::move(ps)](const Vec2& place) {
    const auto above = std::lower_bound(xs.begin(), xs.end(), place.x());
    if (above == xs.begin()) return ps.front();
    if (above == xs.end()) return ps.back();
    const auto i = std::size_t(above - xs.begin());
    const double t = (place.x() - xs[i - 1]) / (xs[i] - xs[i - 1]);
    return (1 - t) * ps[i - 1] + t * ps[i];
  };
}

}  // namespace mortise::chart
