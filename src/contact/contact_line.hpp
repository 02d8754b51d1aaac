// The smooth curve that the edges of a contact curve stand for: rebuilt through their nodes.
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

/// 3-node edges whose middle nodes lie on the chords although the curve turns at their vertices.
struct StraightSides {
  int vertices;    ///< at which the curve turns by 1 to 20 degrees between straight edges
  double sagitta;  ///< how far the curve lies from the longest such chord, h theta / 8, length
  Vec2 position;   ///< the vertex of that chord
};

/// Nothing below three such vertices: fewer may be kinks that are meant.
std::optional<StraightSides> straight_sides(const Points& nodes, const Curve& curve);

/// A polynomial piece an edge, through all nodes of the edge. At each node the pieces on both sides have the tangent of
/// the quartic through five nodes there, so that normals are off by h^4; kinks stay. Where 3-node edges are straight
/// although the curve turns, their middle nodes say nothing of it and are left out.
///
/// Two meshes of one curve show gaps that it does not have, kappa' h^3 / (72 sqrt 3) of 3-node edges and
/// kappa h^2 / 8 of 2-node ones, and their normals are off by h^2 kappa' / 12 and h kappa / 2 (docs/theory.md section
/// 9).
class ContactLine {
 public:
  ContactLine(const Points& nodes, const Curve& curve);

  /// xi: of the edge's piece, by the length along the chords between its nodes, -1 ... 1 and a little beyond.
  LinePoint at(int edge, double xi) const;

  /// Where the normal of the edge's piece passes through x. Nothing unless it does so near `start`.
  std::optional<double> foot(int edge, const Vec2& x, double start) const;

  /// Where the straight line through x along n meets the edge's piece. Nothing unless it does so near `start`.
  std::optional<double> crossing(int edge, const Vec2& x, const Vec2& n, double start) const;

  /// Of each vertex (vertex i begins edge i): whether the boundary really turns there.
  const std::vector<char>& kinks() const { return kinks_; }

 private:
  // Newton's form through up to three double nodes (Hermite): c_0 + c_1 (xi - z_0) + c_2 (xi - z_0) (xi - z_1) + ...
  struct Piece {
    int count = 0;
    std::array<double, 6> z{};
    std::array<Vec2, 6> c{};
  };
  std::vector<Piece> pieces_;
  std::vector<char> kinks_;
};

/// What contact takes from the curves that the meshes stand for; the rest is the edges' own.
struct ContactLines {
  ContactLine multiplier, opposite;
  bool normals, gap;
};

/// How far a side's edge lies off its line, along n through a place near xi on the edge: (line - x) . n, length.
double offset(const ContactLine& line, int edge, double xi, const Vec2& x, const Vec2& n);

}  // namespace mortise
