#include "contact/contact_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
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

// The derivative by the length along the chords at node k of the polynomial through it and `others`, 6 or less, of its
// neighbours where there are so many. At a kink: of the side before it or after it.
Vec2 tangent_at(const Knots& knots, int k, bool after, int others) {
  int back = knots.turns(k) && after ? 0 : knots.within_reach(k, -1, others);
  int ahead = knots.turns(k) && !after ? 0 : knots.within_reach(k, 1, others);
  const int before = std::min(back, std::max(others / 2, others - ahead));
  ahead = std::min(ahead, others - before);
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

double LinePoint::curvature() const { return cross(tangent, bend) / std::pow(tangent.norm(), 3); }

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

LinePiece through(double begin, const SamplePiece& samples) {
  constexpr int last = LinePiece::most - 1;
  const auto& x = samples.places;
  const Vec2 chord = x[last] - x[0];
  LinePiece piece{begin, samples.end, 2, {-1, 1}, {x[0], x[last]}};  // where the drawn curve is straight
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

// All nodes that the line goes through.
Knots knots_of(const Points& nodes, const Curve& curve) {
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
  return knots;
}

// `others`: of tangent_at.
std::vector<LinePiece> through_nodes(const Knots& knots, int edges, int others) {
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
      slopes[j] = s[count - 1] / 2 * tangent_at(knots, first + j, j + 1 < count, others);
    }
    divide_differences(piece, slopes);
    pieces.push_back(piece);
  }
  return pieces;
}

}  // namespace

LinePoint place_on(const LinePiece& p, double xi) {
  const double scale = 2 / (p.end - p.begin), zeta = scale * (xi - p.begin) - 1;
  LinePoint point{p.c[p.count - 1], Vec2::Zero(), Vec2::Zero()};
  for (int i = p.count - 2; i >= 0; --i) {
    const double d = zeta - p.z[i];
    point.bend = d * point.bend + 2 * point.tangent;
    point.tangent = d * point.tangent + point.position;
    point.position = d * point.position + p.c[i];
  }
  point.tangent *= scale;
  point.bend *= scale * scale;
  return point;
}

namespace {

// Of each edge how far the line through the nodes may be from the curve, length, by what it shows itself. Its tangents
// through five nodes instead of seven put the middle of an interval elsewhere; and where its curvature jumps by J at a
// node, as it does where the curve's changes faster than the nodes show, it is off by J h^2 / 32 in the interval beside
// of length h, as cubics are of a third derivative that jumps. Both reach as far as seven nodes do.
std::vector<double> uncertainty_of(const Knots& knots, const std::vector<LinePiece>& pieces) {
  const int edges = int(pieces.size()), count = knots.per_edge;
  const std::vector<LinePiece> other = through_nodes(knots, edges, 4);
  std::vector<double> off(edges, 0.0);
  for (int e = 0; e < edges; ++e) {
    for (int j = 0; j < count; ++j) {
      const double xi = (pieces[e].z[2 * j] + pieces[e].z[2 * j + 2]) / 2;
      off[e] = std::max(off[e], (place_on(pieces[e], xi).position - place_on(other[e], xi).position).norm());
    }
  }
  for (int e = knots.closed ? 0 : 1; e < edges; ++e) {
    const int before = (e + edges - 1) % edges, vertex = count * e;
    if (knots.turns(vertex)) continue;
    const double jump = std::abs(place_on(pieces[before], 1).curvature() - place_on(pieces[e], -1).curvature());
    const double h = std::max((knots[vertex] - knots[vertex - 1]).norm(), (knots[vertex + 1] - knots[vertex]).norm());
    for (const int beside : {before, e}) off[beside] = std::max(off[beside], jump * h * h / 32);
  }
  std::vector<double> widest(edges, 0.0);
  const int reach = knots.per_edge == 1 ? 3 : 2;
  for (int e = 0; e < edges; ++e)
    for (int k = e - reach; k <= e + reach; ++k)
      if (knots.closed || (k >= 0 && k < edges)) widest[e] = std::max(widest[e], 2 * off[(k % edges + edges) % edges]);
  return widest;
}

}  // namespace

ContactLine::ContactLine(const Points& nodes, const Curve& curve) {
  if (curve.samples.empty()) {
    const Knots knots = knots_of(nodes, curve);
    pieces_ = through_nodes(knots, int(curve.edges.size()), 6);
    first_.resize(pieces_.size() + 1);
    std::iota(first_.begin(), first_.end(), 0);
    uncertainty_ = uncertainty_of(knots, pieces_);
    return;
  }
  for (const EdgeSamples& samples : curve.samples) {
    first_.push_back(int(pieces_.size()));
    double begin = -1;
    for (const SamplePiece& piece : samples.pieces) {
      pieces_.push_back(through(begin, piece));
      begin = piece.end;
    }
    uncertainty_.push_back(samples.misfit);
  }
  first_.push_back(int(pieces_.size()));
}

std::span<const LinePiece> ContactLine::pieces(int edge) const {
  return {&pieces_[first_[edge]], std::size_t(first_[edge + 1] - first_[edge])};
}

LinePoint ContactLine::at(int edge, double xi) const {
  const std::span<const LinePiece> of = pieces(edge);
  if (of.size() == 1) return place_on(of[0], xi);
  // A short piece says nothing far beyond itself: the line goes on with the curvature that it has at the edge's end.
  const double inside = std::clamp(xi, -1.0, 1.0), beyond = xi - inside;
  std::size_t k = 0;
  while (k + 1 < of.size() && of[k].end < inside) ++k;
  LinePoint point = place_on(of[k], inside);
  point.position += beyond * (point.tangent + beyond / 2 * point.bend);
  point.tangent += beyond * point.bend;
  return point;
}

namespace {

// Newton's method for a function of xi and its derivative; nothing where it leaves the neighbourhood of the edge.
template <typename Function>
std::optional<double> newton(double xi, const Function& function) {
  for (int step = 0; step < 20; ++step) {
    const auto [value, slope] = function(xi);
    const double change = -value / slope;
    xi += change;
    if (!(std::abs(xi) < 1.5)) return {};
    if (std::abs(change) < 1e-14) return xi;
  }
  return xi;  // goes on between neighbours in round-off
}

// The same between two places at which the function has different signs: what leaves them is halved.
template <typename Function>
double bracketed(double low, double high, bool rises, const Function& function) {
  double xi = (low + high) / 2;
  for (int step = 0; step < 60 && high - low > 1e-15; ++step) {
    const auto [value, slope] = function(xi);
    if (value == 0) return xi;
    ((value < 0) == rises ? low : high) = xi;
    const double next = xi - value / slope;
    if (next > low && next < high && std::abs(next - xi) < 1e-14) return next;
    xi = next > low && next < high ? next : (low + high) / 2;
  }
  return xi;
}

// Where the pieces of an edge meet the function's derivative jumps, and a step across may lead back and forth: so the
// piece on which the function changes its sign is found first, of several the one nearest to `start`.
template <typename Function>
std::optional<double> root(std::span<const LinePiece> pieces, double start, const Function& function) {
  if (pieces.size() == 1) return newton(start, function);
  std::optional<double> best;
  const double first = function(-1).first;
  double begin = first;
  for (const LinePiece& piece : pieces) {
    const double end = function(piece.end).first;
    if ((begin < 0) != (end < 0)) {
      const double xi = bracketed(piece.begin, piece.end, begin < 0, function);
      if (!best || std::abs(xi - start) < std::abs(*best - start)) best = xi;
    }
    begin = end;
  }
  return best ? best : newton(std::abs(first) < std::abs(begin) ? -1 : 1, function);
}

}  // namespace

std::optional<double> ContactLine::foot(int edge, const Vec2& x, double start) const {
  return root(pieces(edge), start, [&](double xi) {
    const LinePoint p = at(edge, xi);
    const Vec2 away = x - p.position;
    return std::pair(away.dot(p.tangent), away.dot(p.bend) - p.tangent.squaredNorm());
  });
}

std::optional<double> ContactLine::crossing(int edge, const Vec2& x, const Vec2& n, double start) const {
  return root(pieces(edge), start, [&](double xi) {
    const LinePoint p = at(edge, xi);
    return std::pair(cross(p.position - x, n), cross(p.tangent, n));
  });
}

}  // namespace mortise
