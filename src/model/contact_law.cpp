#include "model/contact_law.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace mortise {
namespace {

// The ends of the piece that has x as its coordinate `along` (0: overlap, 1: pressure).
std::pair<Vec2, Vec2> piece(const std::vector<Vec2>& points, double x, int along) {
  const auto above = std::ranges::find_if(points, [&](const Vec2& point) { return point(along) >= x; });
  const auto end = above == points.end() ? above - 1 : above;
  return {end == points.begin() ? Vec2(0, 0) : *(end - 1), *end};
}

// The piece's height at x, from coordinate `along` to the other.
double straight(const std::vector<Vec2>& points, double x, int along) {
  const auto [from, to] = piece(points, x, along);
  return from(1 - along) + (x - from(along)) * (to - from)(1 - along) / (to - from)(along);
}

}  // namespace

double ContactLaw::pressure(double d) const {
  const double size = std::abs(d), last = points.back().x();
  return std::copysign(exponent == 1 ? straight(points, size, 0) : points.back().y() * std::pow(size / last, exponent),
                       d);
}

double ContactLaw::slope(double d) const {
  const auto [from, to] = piece(points, std::abs(d), 0);
  const double mean = (to - from).y() / (to - from).x();
  return exponent == 1 ? mean : exponent * mean * std::pow(std::abs(d) / to.x(), exponent - 1);
}

double ContactLaw::overlap(double p) const {
  const double size = std::abs(p);
  return std::copysign(
      exponent == 1 ? straight(points, size, 1) : points.back().x() * std::pow(size / points.back().y(), 1 / exponent),
      p);
}

std::string ContactLaw::words() const {
  std::ostringstream words;
  if (is_linear())
    words << "stiffness " << slope(0);
  else if (points.size() == 1)
    words << "p = " << points[0].y() << " (overlap / " << points[0].x() << ")^" << exponent;
  else
    words << "p by a table of " << points.size();
  return words.str();
}

}  // namespace mortise
