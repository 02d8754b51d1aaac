// The pressure of a contact pair along its multiplier side, vertex by vertex, as its error estimates see it.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "problem/contact_pair.hpp"

namespace mortise {

inline constexpr double loaded_part = 1e-9;  ///< of the largest p; less is none

/// Vertices in the order of the curve's edges, the first one again at the end of a closed curve: edge e joins vertices
/// e and e + 1. Each of size edges + 1.
struct PressureLine {
  bool closed = false;
  std::vector<Vec2> position;
  VecX s;                   ///< arc length from the first vertex
  VecX p;                   ///< pressure, without `fluid`
  VecX fluid;               ///< of the pressure what counts as the fluid's; empty: there is none
  VecX middle;              ///< the pressure at the middle of each edge, where multipliers stand there; else empty
  VecX h;                   ///< length that counts for the vertex: half of both edges, or the one edge of an end
  std::vector<char> faced;  ///< of each edge, whether a part of it faces the other side
  /// Vertices that take part: loaded, or next to one that is, on edges that are faced.
  std::vector<char> loaded;

  double whole(Eigen::Index i) const { return fluid.size() > 0 ? p(i) + fluid(i) : p(i); }  ///< pressure at vertex i
  /// Whether edges are faced before and after vertex i.
  std::array<bool, 2> faced_beside(Eigen::Index i) const;
  /// The next vertex by 1 or -1, around a closed line on and on; none beyond an end.
  std::optional<Eigen::Index> beside(Eigen::Index i, int step) const;
  /// The edge between a vertex and the one before it by `step`.
  static Eigen::Index edge_to(Eigen::Index i, int step) { return step < 0 ? i : i - 1; }
  /// The vertex nearest to a place.
  Eigen::Index nearest(const Vec2& x) const;
  /// The place on the chords of its edges nearest to a place, such as a corner of the opposite side across a gap.
  Vec2 foot(const Vec2& x) const;
  Vec2 at(double place) const;  ///< on the chords of its edges, by arc length
  /// Between two places by their arc lengths; around a closed line the shorter way.
  double distance(double one, double other) const;
};

/// `lambda`: row values of all pairs, stress. Where p is nowhere above `round_off` (stress) nothing is loaded: p is 0.
/// `fluid`: as Problem::fluid. Contact carries the fluid's pressure where the fluid's way ends, and
/// more behind it: what counts as the fluid's falls from there along the line to the other end of contact, so that p
/// rises as a root from either.
PressureLine pressure_line(const Mesh& mesh, const ContactPair& pair, const VecX& lambda, double round_off,
                           const VecX& fluid = {});

/// What round-off of the displacements makes of a contact that carries nothing, stress: as the softer body feels it,
/// for the stiffer one's displacements give way to it. `laws`: one a body; `displacement`: the largest.
double round_off_pressure(const Mesh& mesh, const ContactPair& pair, const std::vector<ElasticLaw>& laws,
                          double displacement);

/// What the pressure along the line is off by, from itself: near a vertex where the slope of p jumps by J it is a
/// piecewise linear function's h J / 8 at its worst and sqrt(h^3 J^2 / 120) in L2; at the border of contact, where p
/// rises as a root, p an edge further on times sqrt(h) / 4 (docs/theory.md eq. 47). Where the other side ends, within
/// an edge or not, is known: that is an end of the line, no border.
struct LineError {
  LineError() = default;
  /// Of a pressure that is known.
  explicit LineError(Eigen::Index vertices)
      : l2(VecX::Zero(vertices)),
        data(l2),
        swing(l2),
        worst(VecX::Ones(vertices)),
        missed(l2),
        border(vertices, 0),
        least(l2) {}

  VecX l2;  ///< of each vertex, stress sqrt(length)
  /// Likewise, of what no pressure along the line tells, such as a gap that the mesh does not follow.
  VecX data;
  /// Parts of `data` at points where p goes as a small power of the distance or its logarithm: they fall as `power` of
  /// the length of the edges there.
  struct Weak {
    Eigen::Index vertex;
    double part, power;
    bool at_end;  ///< of the line: the bodies' angles say how p goes; else it depends on how far they slide
  };
  std::vector<Weak> weak;
  /// Parts of `data` of loads beside the line that a cell does not follow: they fall as `power` of its size.
  struct Load {
    Eigen::Index vertex;
    double part;
    Vec2 place;
    double cell;  ///< its size, length
    int power;
  };
  std::vector<Load> loads;
  /// Likewise, of what p swings by about its slopes. Edges of the next mesh are made by `l2` and `data`, whose rates
  /// are known.
  VecX swing;
  VecX worst;   ///< by how much more than l2 says p is off at the worst of these vertices
  VecX missed;  ///< likewise, of contact that the mesh does not notice
  /// A place of contact that is narrower than the edges there.
  struct Narrow {
    Vec2 place;
    double edge;        ///< so long are edges that show its width
    double square = 0;  ///< its share of int p^2 ds, where that is known
  };
  std::vector<Narrow> missed_at;  ///< of contact that the mesh does not notice
  std::vector<Narrow> narrow_at;  ///< of contact that it does (error/narrow_contact.hpp)
  /// Of the worst of a piecewise linear function's error, J h / 8, over l2 / sqrt(h), which is sqrt(h^2 J^2 / 120).
  static constexpr double pointwise_factor = 1.3693063937629153;  // sqrt(120) / 8
  std::vector<char> border;                                       ///< whether the border of contact makes it
  struct Border {
    Eigen::Index edge;              ///< on which contact ends
    double part;                    ///< its length over half the width of the contact beside it
    double root;                    ///< p rises as this times the root of the distance, stress / sqrt(length)
    double reach;                   ///< as far as it does so, length
    std::optional<double> place{};  ///< its s, where that of p* is credible; else it is known to an edge
  };
  std::vector<Border> borders;
  /// What p is off by at least, of vertices at which it goes as a small power of the distance, or that hardly face the
  /// other side, stress.
  VecX least;
  void raise(Eigen::Index vertex, double by);     ///< `least` at a vertex
  void add_data(Eigen::Index vertex, double by);  ///< a square to that of `data`
  void add_weak(const Weak& weak);                ///< to `data` too
  void add_load(const Load& load);                ///< likewise
  VecX along() const { return l2 + data; }
  VecX whole() const;  ///< of each vertex the largest of along(), `swing` and `missed`
  /// At each vertex what p is off by, stress: the largest within four edges. What the border makes falls with the
  /// distance r from it as sqrt(h / r): that is what moving it does to a root.
  VecX pointwise(const PressureLine& line) const;
};

LineError line_error(const PressureLine& line);

/// The vertices whose error a border makes: of its edge, and one beyond each end.
std::vector<Eigen::Index> vertices_at(const PressureLine& line, const LineError::Border& border);

/// The vertex beyond a border.
Eigen::Index open_vertex(const PressureLine& line, const LineError::Border& border);

/// Raises `least` where the edges of a vertex hardly face the other side: its p is that of the nearest free node (or
/// what little they face makes of it), and is known no better than to its own size.
void add_hardly_faced(const ContactPair& pair, const PressureLine& line, LineError& error);

/// Raises `least` at an end on the axis of rings, about which p is even, by what p is off there from the parabola
/// through the next two vertices: on 3-node triangles the multiplier of the axis, which weighs next to nothing, is off
/// by a part of h.
void add_axis_end(const ContactPair& pair, const PressureLine& line, LineError& error);

}  // namespace mortise
