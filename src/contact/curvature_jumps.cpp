#include "contact/curvature_jumps.hpp"

#include <cmath>
#include <numbers>

#include "base/vectors.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

constexpr double sharpest_joint =
    2 * std::numbers::pi / 180;  // as of kinks that exponents tell of (singular_points.cpp)

// A jump that would turn the normals of the whole curve by less: p feels it by its product with the sliding, which is
// a small part of the length again.
constexpr double least_turn = 0.01;

double curvature(const LinePoint& p) { return cross(p.tangent, p.bend) / std::pow(p.tangent.norm(), 3); }

}  // namespace

std::vector<CurvatureJump> curvature_jumps(const Points& nodes, const Curve& curve, const ContactLine& line) {
  std::vector<CurvatureJump> jumps;
  if (curve.samples.empty()) return jumps;
  const double least = least_turn / curve_length(nodes, curve);
  const auto look = [&](int edge, double xi, const LinePoint& before, const LinePoint& after) {
    const double jump = std::abs(curvature(after) - curvature(before));
    if (jump > least && angle_between(before.tangent, after.tangent) < sharpest_joint)
      jumps.push_back({edge, xi, jump});
  };
  const int edges = int(curve.edges.size());
  for (int e = 0; e < edges; ++e) {
    if (e > 0 || curve.closed) look(e, -1, line.at((e + edges - 1) % edges, 1), line.at(e, -1));
    const std::span<const LinePiece> pieces = line.pieces(e);
    for (std::size_t k = 1; k < pieces.size(); ++k)
      look(e, pieces[k].begin, place_on(pieces[k - 1], pieces[k].begin), place_on(pieces[k], pieces[k].begin));
  }
  return jumps;
}

}  // namespace mortise
