// The smooth curve that the edges of a contact curve stand for: as drawn, or rebuilt through their nodes.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "mesh/curve.hpp"

namespace mortise {

/// A place on a contact line, and its derivatives by the piece's coordinate.
struct LinePoint {
  Vec2 position, tangent, bend;  ///< length; tangent along the curve's edges, the body on its left

  Vec2 normal() const;       ///< unit, out of the body
  double curvature() const;  ///< 1 / length, positive where the line turns to the left
};

/// A polynomial of a coordinate that is -1 at its begin and 1 at its end, in Newton's form: c_0 + c_1 (zeta - z_0) +
/// c_2 (zeta - z_0) (zeta - z_1) + ...
struct LinePiece {
  static constexpr int most = std::tuple_size_v<decltype(SamplePiece::places)>;
  double begin = -1, end = 1;  ///< coordinate of the edge
  int count = 0;
  std::array<double, most> z{};
  std::array<Vec2, most> c{};
};

/// By the edge's coordinate.
LinePoint place_on(const LinePiece& piece, double xi);

/// Polynomial pieces: of each edge those of the drawn curve, or, where only the mesh is known, one through all
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

  /// xi: of the edge, by the drawn curve's parameter or the length along the chords between the edge's nodes; -1 ... 1
  /// and a little beyond.
  LinePoint at(int edge, double xi) const;

  /// The place whose normal on the edge's line passes through x; nothing unless it is near the edge.
  std::optional<double> foot(int edge, const Vec2& x, double start) const;

  /// The place where the straight line through x along n meets the edge's line; nothing unless it is near the edge.
  std::optional<double> crossing(int edge, const Vec2& x, const Vec2& n, double start) const;

  /// How far the curve that the edge stands for may lie from the line, length: what the pieces miss of the drawn curve;
  /// of a curve rebuilt from nodes twice what its tangents and its curvature at the nodes there leave open
  /// (docs/theory.md section 9).
  double uncertainty(int edge) const { return uncertainty_[edge]; }

  /// The edge's pieces, one or more, from its start to its end.
  std::span<const LinePiece> pieces(int edge) const;

 private:
  std::vector<LinePiece> pieces_;
  std::vector<int> first_;  // of each edge, and one behind the last
  std::vector<double> uncertainty_;
};

}  // namespace mortise
