#include "contact/curvature_jumps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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

// What round-off of the samples' coordinates makes of the curvature at the end of a piece of length h, times eps x /
// h^2 with x the largest of them: up to 2100 of random arcs, and places that gmsh computes are off by several eps.
constexpr double round_off_of_curvatures = 1e4;

// The same times m / h^2 with m the misfit of the edges beside (as of directions, singular_points.cpp): of a polynomial
// of degree n second derivatives are off by n^2 (n^2 - 1) / 3 r / (h / 2)^2 or less, on both sides.
constexpr double misfit_of_curvatures = 2 * 2 * 5376;

}  // namespace

std::vector<CurvatureJump> curvature_jumps(const Points& nodes, const Curve& curve, const ContactLine& line) {
  std::vector<CurvatureJump> jumps;
  if (curve.samples.empty()) return jumps;
  const double least = least_turn / curve_length(nodes, curve);
  // Where the line goes on from one piece to the next, which begins at xi of its edge.
  const auto look = [&](const LinePiece& from, const LinePiece& to, int edge_before, int edge) {
    const double xi = to.begin;
    const LinePoint before = place_on(from, from.end), after = place_on(to, xi);
    const double h = std::min((from.end - from.begin) * before.tangent.norm(), (to.end - xi) * after.tangent.norm());
    const double misfit = std::max(curve.samples[edge_before].misfit, curve.samples[edge].misfit);
    const double off =
        round_off_of_curvatures * std::numeric_limits<double>::epsilon() * after.position.lpNorm<Eigen::Infinity>() +
        misfit_of_curvatures * misfit;
    const double round_off = off / (h * h);
    const double jump = std::abs(after.curvature() - before.curvature());
    if (jump > std::max(least, round_off) && angle_between(before.tangent, after.tangent) < sharpest_joint)
      jumps.push_back({edge, xi, jump});
  };
  const int edges = int(curve.edges.size());
  for (int e = 0; e < edges; ++e) {
    const std::span<const LinePiece> pieces = line.pieces(e);
    const int before = (e + edges - 1) % edges;
    if (e > 0 || curve.closed) look(line.pieces(before).back(), pieces.front(), before, e);
    for (std::size_t k = 1; k < pieces.size(); ++k) look(pieces[k - 1], pieces[k], e, e);
  }
  return jumps;
}

}  // namespace mortise
