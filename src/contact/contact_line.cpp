#include "contact/contact_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "base/vectors.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

constexpr double degrees = std::numbers::pi / 180;

// The nodes that the line goes through, in their order; node k and node k + 1 bound an interval, on a closed curve also
// the last and the first.
struct Knots {
  std::vector<Vec2> x;
  std::vector<char> kink;  // of each
  bool closed;
  int per_edge;  // intervals: 2 with middle nodes, else 1

  int size() const { return int(x.size()); }
  int wrapped(int k) const { return closed ? (k % size() + size()) % size() : k; }
  const Vec2& operator[](int k) const { return x[wrapped(k)]; }
  bool exists(int k) const { return closed || (k >= 0 && k < size()); }
  bool turns(int k) const { return kink[wrapped(k)]; }

  // How many nodes, `most` or fewer, follow node k in a direction without a kink between.
  int within_reach(int k, int direction, int most) const {
    int count = 0;
    while (count < most && count < size() - 1 && exists(k + direction * (count + 1)) &&
           (count == 0 || !turns(k + direction * count)))
      ++count;
    return count;
  }
};

// The derivative by the length along the chords at node k of the polynomial through it and its neighbours, seven nodes
// where there are so many. At a kink: of the side before it or after it.
Vec2 tangent_at(const Knots& knots, int k, bool after) {
  int back = knots.turns(k) && after ? 0 : knots.within_reach(k, -1, 6);
  int ahead = knots.turns(k) && !after ? 0 : knots.within_reach(k, 1, 6);
  const int before = std::min(back, std::max(3, 6 - ahead));
  ahead = std::min(ahead, 6 - before);
  back = before;
  std::array<double, 7> s{};
  for (int j = back - 1; j >= 0; --j) s[j] = s[j + 1] - (knots[k - back + j + 1] - knots[k - back + j]).norm();
  for (int j = back + 1; j <= back + ahead; ++j)
    s[j] = s[j - 1] + (knots[k - back + j] - knots[k - back + j - 1]).norm();
  Vec2 tangent = Vec2::Zero();
  for (int j = 0; j <= back + ahead; ++j) {
    if (j == back) continue;  // its share is minus the sum of the others'
    double weight = 1;        // l_j'(0)
    for (int m = 0; m <= back + ahead; ++m) {
      if (m == j) continue;
      weight /= s[j] - s[m];
      if (m != back) weight *= -s[m];
    }
    tangent += weight * (knots[k - back + j] - knots[k]);
  }
  return tangent;
}

double bend(const Points& nodes, const Edge& e) {
  return angle_between(edge_point(nodes, e, -1).tangent, edge_point(nodes, e, 1).tangent);
}

// How much the edges turn at each vertex (vertex i begins edge i), 0 at the ends of an open curve.
std::vector<double> turns_of(const Points& nodes, const Curve& curve, bool by_chords) {
  const int edges = int(curve.edges.size());
  const auto direction = [&](int e, double xi) -> Vec2 {
    const Edge& edge = curve.edges[e];
    if (by_chords) return (nodes.row(edge.nodes[1]) - nodes.row(edge.nodes[0])).transpose();
    return edge_point(nodes, edge, xi).tangent;
  };
  std::vector<double> turns(edges + !curve.closed, 0.0);
  for (int i = curve.closed ? 0 : 1; i < edges; ++i)
    turns[i] = angle_between(direction((i + edges - 1) % edges, 1), direction(i, -1));
  return turns;
}

// Where the boundary really turns. The vertices of a mesh of a smooth curve turn like those beside, and less than
// curved edges do: a kink turns by more than 20 degrees (between chords only if that is 3 times as much as at a vertex
// beside, or more than 60), or it turns 3 times as much as at both vertices beside and half as much as the edges there.
std::vector<char> kinks_of(const Points& nodes, const Curve& curve, bool by_chords) {
  const std::vector<double> turns = turns_of(nodes, curve, by_chords);
  const int count = int(turns.size()), edges = int(curve.edges.size());
  std::vector<char> kinks(count, 0);
  for (int i = curve.closed ? 0 : 1; i < edges; ++i) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    int beside = 0;
    for (const int k : {i - 1, i + 1})
      if (curve.closed || (k > 0 && k < edges)) {
        least = std::min(least, turns[(k + count) % count]);
        most = std::max(most, turns[(k + count) % count]);
        ++beside;
      }
    const double bends =
        by_chords ? 0 : std::max(bend(nodes, curve.edges[(i + edges - 1) % edges]), bend(nodes, curve.edges[i]));
    const bool alike = by_chords && beside > 0 && turns[i] < 3 * least && turns[i] < 60 * degrees;
    const bool alone = beside == 2 && turns[i] > 0.1 * degrees && turns[i] > 3 * most && turns[i] > bends / 2;
    kinks[i] = (turns[i] > 20 * degrees && !alike) || alone;
  }
  return kinks;
}

}  // namespace

Vec2 LinePoint::normal() const { return Vec2(tangent.y(), -tangent.x()).normalized(); }

namespace {

// Whether the middle nodes of 3-node edges lie on the chords although the curve turns at its vertices. Nothing is said
// by fewer than three such vertices: they may be kinks that are meant.
bool straight_sides(const Points& nodes, const Curve& curve) {
  const std::vector<double> turns = turns_of(nodes, curve, false);
  const std::vector<char> kinks = kinks_of(nodes, curve, true);
  const int edges = int(curve.edges.size());
  int vertices = 0;
  for (int i = curve.closed ? 0 : 1; i < edges; ++i) {
    const Edge &before = curve.edges[(i + edges - 1) % edges], &after = curve.edges[i];
    if (after.node_count == 2 || turns[i] < 1e-4 * degrees || kinks[i]) continue;
    vertices += std::max(bend(nodes, before), bend(nodes, after)) <= 0.1 * turns[i];
  }
  return vertices >= 3;
}

// From values c at z to the coefficients. At a z that stands twice, slopes[i / 2] is the derivative.
void divide_differences(LinePiece& piece, std::span<const Vec2> slopes = {}) {
  for (int order = 1; order < piece.count; ++order)
    for (int i = piece.count - 1; i >= order; --i)
      piece.c[i] = piece.z[i] == piece.z[i - order]
                       ? slopes[i / 2]
                       : Vec2((piece.c[i] - piece.c[i - 1]) / (piece.z[i] - piece.z[i - order]));
}

LinePiece through(const EdgeSamples& x) {
  constexpr int last = std::tuple_size_v<EdgeSamples> - 1;
  const Vec2 chord = x[last] - x[0];
  LinePiece piece{.count = 2, .z = {-1, 1}, .c = {x[0], x[last]}};  // where the drawn curve is straight
  if (std::ranges::any_of(
          x, [&](const Vec2& place) { return std::abs(cross(chord, place - x[0])) > 1e-14 * chord.squaredNorm(); })) {
    piece.count = last + 1;
    for (int k = 0; k <= last; ++k) {
      piece.z[k] = -std::cos(std::numbers::pi * k / last);
      piece.c[k] = x[k];
    }
  }
  divide_differences(piece);
  return piece;
}

std::vector<LinePiece> through_nodes(const Points& nodes, const Curve& curve) {
  const bool by_ends = curve.edges[0].node_count == 2 || straight_sides(nodes, curve);
  const std::vector<char> kinks = kinks_of(nodes, curve, by_ends);
  Knots knots{{}, {}, curve.closed, by_ends ? 1 : 2};
  const int edges = int(curve.edges.size());
  for (int e = 0; e < edges; ++e) {
    const Edge& edge = curve.edges[e];
    knots.x.push_back(nodes.row(edge.nodes[0]).transpose());
    knots.kink.push_back(kinks[e]);
    if (by_ends) continue;
    knots.x.push_back(nodes.row(edge.nodes[2]).transpose());
    knots.kink.push_back(0);
  }
  if (!curve.closed) {
    knots.x.push_back(nodes.row(curve.edges.back().nodes[1]).transpose());
    knots.kink.push_back(0);
  }
  std::vector<LinePiece> pieces;
  for (int e = 0; e < edges; ++e) {
    const int first = knots.per_edge * e, count = knots.per_edge + 1;
    std::array<double, 3> s{};  // of the edge's nodes, by chords
    for (int j = 1; j < count; ++j) s[j] = s[j - 1] + (knots[first + j] - knots[first + j - 1]).norm();
    LinePiece piece{.count = 2 * count, .z = {}, .c = {}};
    std::array<Vec2, 3> slopes;
    for (int j = 0; j < count; ++j) {
      piece.z[2 * j] = piece.z[2 * j + 1] = 2 * s[j] / s[count - 1] - 1;
      piece.c[2 * j] = piece.c[2 * j + 1] = knots[first + j];
      slopes[j] = s[count - 1] / 2 * tangent_at(knots, first + j, j + 1 < count);
    }
    divide_differences(piece, slopes);
    pieces.push_back(piece);
  }
  return pieces;
}

}  // namespace

ContactLine::ContactLine(const Points& nodes, const Curve& curve) {
  if (curve.samples.empty()) pieces_ = through_nodes(nodes, curve);
  for (const EdgeSamples& samples : curve.samples) pieces_.push_back(through(samples));
}

LinePoint ContactLine::at(int edge, double xi) const {
  const LinePiece& p = pieces_[edge];
  LinePoint point{p.c[p.count - 1], Vec2::Zero(), Vec2::Zero()};
  for (int i = p.count - 2; i >= 0; --i) {
    const double d = xi - p.z[i];
    point.bend = d * point.bend + 2 * point.tangent;
    point.tangent = d * point.tangent + point.position;
    point.position = d * point.position + p.c[i];
  }
  return point;
}

namespace {

// Newton's method for a function of xi and its derivative; nothing where it leaves the neighbourhood of the piece.
template <typename Function>
std::optional<double> root(double xi, const Function& function) {
  for (int step = 0; step < 20; ++step) {
    const auto [value, slope] = function(xi);
    const double change = -value / slope;
    xi += change;
    if (!(std::abs(xi) < 1.5)) return {};
    if (std::abs(change) < 1e-14) return xi;
  }
  return xi;  // goes on between neighbours in round-off
}

}  // namespace

std::optional<double> ContactLine::foot(int edge, const Vec2& x, double start) const {
  return root(start, [&](double xi) {
    const LinePoint p = at(edge, xi);
    const Vec2 away = x - p.position;
    return std::pair(away.dot(p.tangent), away.dot(p.bend) - p.tangent.squaredNorm());
  });
}

std::optional<double> ContactLine::crossing(int edge, const Vec2& x, const Vec2& n, double start) const {
  return root(start, [&](double xi) {
    const LinePoint p = at(edge, xi);
    return std::pair(cross(p.position - x, n), cross(p.tangent, n));
  });
}

}  // namespace mortise
