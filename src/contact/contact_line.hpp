// The smooth curve that the edges of a contact curve stand for: as drawn, or rebuilt through their nodes.
#pragma once

#include <array>
#include <optional>

#include "mesh/curve.hpp"

namespace mortise {

/// A place on a contact line, and its derivatives by the piece's coordinate.
struct LinePoint {
  Vec2 position, tangent, bend;  ///< length; tangent along the curve's edges, the body on its left

  Vec2 normal() const;  ///< unit, out of the body
};

/// A polynomial in Newton's form: c_0 + c_1 (xi - z_0) + c_2 (xi - z_0) (xi - z_1) + ...
struct LinePiece {
  int count = 0;
  std::array<double, std::tuple_size_v<EdgeSamples>> z{};
  std::array<Vec2, std::tuple_size_v<EdgeSamples>> c{};
};

/// A polynomial piece an edge: through the samples of the drawn curve, or, where only the mesh is known, through all
/// nodes of the edge. At each node the pieces on both sides then have the tangent of the polynomial through seven nodes
/// there, so that places are off by h^4 or less and normals by h^3; kinks stay. Where
/// 3-node edges are straight although the curve turns, their middle nodes say nothing of it and are left out.
///
/// Two meshes of one curve show gaps that it does not have, kappa' h^3 / (72 sqrt 3) of 3-node edges and
/// kappa h^2 / 8 of 2-node ones, and their normals are off by h^2 kappa' / 12 and h kappa / 2 (docs/theory.md section
/// 9).
class ContactLine {
 public:
  ContactLine(const Points& nodes, const Curve& curve);

  /// xi: of the edge's piece, by the drawn curve's parameter or the length along the chords between the edge's nodes;
  /// -1 ... 1 and a little beyond.
  LinePoint at(int edge, double xi) const;

  /// Where the normal of the edge's piece passes through x. Nothing unless it does so near `start`.
  std::optional<double> foot(int edge, const Vec2& x, double start) const;

  /// Where the straight line through x along n meets the edge's piece. Nothing unless it does so near `start`.
  std::optional<double> crossing(int edge, const Vec2& x, const Vec2& n, double start) const;

 private:
  std::vector<LinePiece> pieces_;
};

}  // namespace mortise
