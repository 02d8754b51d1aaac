// The drawn curve along an edge of a mesh: pieces on each of which it is a polynomial of its parameter.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "base/types.hpp"

namespace mortise {

/// A piece by its places where the curve's parameter is -cos(pi k / 8) between those of its ends.
struct SamplePiece {
  double end;  ///< the edge's parameter there, -1 ... 1; the piece begins where the one before ends, the first at -1
  std::array<Vec2, 9> places;
};

struct EdgeSamples {
  std::vector<SamplePiece> pieces;  ///< from the edge's start to its end; the last one's `end` is 1
  double misfit = 0;                ///< how far the drawn curve may lie from the polynomials through them, length
};

/// Along the edge in the other direction.
EdgeSamples reversed(const EdgeSamples& samples);

/// Places of a curve at its parameters.
using CurvePlaces = std::function<std::vector<Vec2>(const std::vector<double>&)>;

/// The edges whose ends have these parameters. Pieces are bisected until the polynomial of degree 8 through each misses
/// the curve between its places by round-off, and those that are one polynomial are put together again. So a knot,
/// where a derivative of the curve jumps, ends a piece, and a curve that is piecewise smooth is known to round-off
/// whatever the mesh. Where bisection does not help the curve has no derivatives: `misfit` says what is missed. Throws
/// what `curve` throws.
std::vector<EdgeSamples> sample_edges(const CurvePlaces& curve, const std::vector<std::array<double, 2>>& ends);

/// The straight edges between the places of these parameters.
std::vector<EdgeSamples> sample_straight_edges(const CurvePlaces& curve,
                                               const std::vector<std::array<double, 2>>& ends);

}  // namespace mortise
