#include "error/tail_shares.hpp"

#include <algorithm>
#include <cmath>

namespace mortise {
namespace {

// Nearer to a window than so many times its reach, what a corner does to p differs within it by more than a third.
constexpr double nearby = 8;

// The place on the line's chords at an arc length.
Vec2 place_at(const PressureLine& line, double s) {
  const Eigen::Index last = line.s.size() - 1;
  const auto after = std::upper_bound(line.s.begin() + 1, line.s.begin() + last, s);
  const Eigen::Index i = after - line.s.begin();
  const double part = std::clamp((s - line.s(i - 1)) / (line.s(i) - line.s(i - 1)), 0.0, 1.0);
  return (1 - part) * line.position[i - 1] + part * line.position[i];
}

// Means of the tail's shape with the window's weight, and of its square over all that the window stands for.
struct Shape {
  double mean, square;
};

Shape shape_of(const PressureLine& line, const PressureWindow& window, const LocalTail& unit) {
  constexpr int samples = 65;
  double mass = 0, sum = 0, squares = 0;
  for (int k = 0; k < samples; ++k) {
    const double z = (2.0 * k + 1) / samples - 1, half = window_width * window.place.reach;
    const double weight = std::pow(1 - z * z, 3);
    mass += weight;
    sum += weight * unit.at(place_at(line, window.s + z * half));
    const double wide = unit.at(place_at(line, window.s + z * window.place.reach));
    squares += wide * wide;
  }
  return {sum / mass, squares / samples};
}

}  // namespace

double LocalTail::at(const Vec2& x) const {
  return amplitude * std::pow(std::max((x - position).norm(), radius), -1 - exponent);
}

std::vector<TailShares> tail_shares(const Mesh& mesh, const std::vector<const PressureLine*>& lines,
                                    const std::vector<const std::vector<PressureWindow>*>& windows,
                                    const SharedDuals& duals, CornerTails& tails) {
  std::vector<std::pair<int, int>> place;  // pair and window of each window of all
  std::vector<TailShares> shares(lines.size());
  for (std::size_t k = 0; k < lines.size(); ++k) {
    shares[k].means = VecX::Zero(Eigen::Index(windows[k]->size()));
    for (int w = 0; w < int(windows[k]->size()); ++w) place.emplace_back(int(k), w);
  }
  tails.norms = VecX::Zero(tails.parts.rows());
  for (Eigen::Index c = 0; c < tails.parts.rows(); ++c) {
    const CornerRings& rings = tails.corners[c];
    const Vec2& x = rings.corner.position;
    double square = 0;
    const auto add = [&](int number, double tail) {
      const auto [pair, w] = place[number];
      const PressureWindow& window = (*windows[pair])[w];
      if ((window.place.centre - x).norm() > nearby * window.place.reach) {
        shares[pair].means(w) += tail;
        square += window.length * tail * tail;
        return;
      }
      LocalTail local{x, rings.corner.exponent, rings.radius[0], w, 1};
      const Shape shape = shape_of(*lines[pair], window, local);
      local.amplitude = tail / shape.mean;
      square += window.length * local.amplitude * local.amplitude * shape.square;
      shares[pair].local.push_back(local);
    };
    const int body = mesh.cells[rings.cells[0][0]].body;
    for (int d = 0; d < duals.count; ++d)
      duals.for_each_window(body, d, x, [&](int window, double part) { add(window, part * tails.parts(c, d)); });
    tails.norms(c) = std::sqrt(square);
  }
  return shares;
}

}  // namespace mortise
