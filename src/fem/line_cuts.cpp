#include "fem/line_cuts.hpp"

#include <algorithm>
#include <array>
#include <queue>

namespace mortise {
namespace {

constexpr int rule_points = 4;      // of the rule that loads are integrated by
constexpr double tolerance = 1e-9;  // of the scale: what is left is round-off beside any accuracy that is asked for
// Of the scale: ranges are wider than values by a part of the piece, and the tails of a spike below it hold 0.4 %.
constexpr double hidden_part = 1. / 256;
constexpr double shortest = 0x1p-40;  // xi of such pieces is told from their ends'
constexpr std::size_t most_pieces = 4096;
constexpr int blind_pieces = 16;                                        // where no range is known
constexpr double epsilon = 8 * std::numeric_limits<double>::epsilon();  // of a few operations

const LineRule& rule() {
  static const LineRule four = gauss_legendre(rule_points);
  return four;
}

using Moments = Eigen::Vector3d;  // of 1, t, t^2

// What four points see of a piece.
struct Sampled {
  double from, to;
  std::array<double, rule_points> at, value;

  double length() const { return to - from; }
  // About a centre: t = (xi - centre) / size.
  Moments moments(double centre, double size) const {
    Moments sum = Moments::Zero();
    for (int q = 0; q < rule_points; ++q) {
      const double t = (at[q] - centre) / size;
      sum += length() / 2 * rule().weights[q] * value[q] * Moments(1, t, t * t);
    }
    return sum;
  }
  Interval values() const {
    const auto [low, high] = std::ranges::minmax(value);
    return {low, high};
  }
};

Interval between(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

struct Piece {
  Sampled whole;
  std::array<Sampled, 2> halves;
  double error;
  bool operator<(const Piece& other) const { return error < other.error; }
};

Sampled sample(const LineFunction& f, double from, double to) {
  Sampled s{from, to, {}, {}};
  for (int q = 0; q < rule_points; ++q) {
    s.at[q] = from + s.length() / 2 * (1 + rule().points[q]);
    s.value[q] = f.at(s.at[q]);
  }
  return s;
}

// By how much f may go beyond its samples, as far as that is more than samples and ranges differ by anyway. Without a
// range the ends are looked at, which no sample is near.
double hidden(const LineFunction& f, const Sampled& whole, const Interval& seen) {
  constexpr double inwards = 1e-3;  // f may be defined on the edge alone
  auto range = f.range(whole.from, whole.to);
  if (!range) {
    const double start = f.at(whole.from + inwards * whole.length()), end = f.at(whole.to - inwards * whole.length());
    range = {std::min(start, end), std::max(start, end)};
  }
  const double slack = (seen.high - seen.low) + hidden_part * f.scale;
  const double beyond = std::max(range->high - seen.high, seen.low - range->low) - slack;
  return std::clamp(beyond, 0.0, 1e6 * f.scale);  // a range that is infinite orders the pieces by their length
}

Piece piece_of(const LineFunction& f, const Sampled& whole) {
  const double middle = (whole.from + whole.to) / 2, half = whole.length() / 2;
  Piece piece{whole, {sample(f, whole.from, middle), sample(f, middle, whole.to)}, 0};
  const auto& [left, right] = piece.halves;
  const Interval seen = hull(whole.values(), hull(left.values(), right.values()));
  const Moments difference = left.moments(middle, half) + right.moments(middle, half) - whole.moments(middle, half);
  piece.error = difference.cwiseAbs().maxCoeff() + whole.length() * hidden(f, whole, seen);
  return piece;
}

}  // namespace

void LineScale::look_at(const LineFunction& f) {
  for (const double xi : rule().points) {
    const double value = f.at(xi);
    values_ = values_ ? hull(*values_, {value, value}) : Interval{value, value};
  }
  if (const auto all = f.range(-1, 1); all && std::isfinite(all->magnitude()))
    range_ = range_ ? hull(*range_, *all) : all;
}

double LineScale::value() const { return scale_of(values_.value_or(Interval{1, 1}), range_); }

LineFunction along_edge(const Points& nodes, const Edge& edge, const Field& field, const FieldRange& range,
                        const std::function<double(double xi)>& s) {
  const bool uses_s = field.uses_arc_length();
  const auto place = [&nodes, edge](double xi) { return edge_point(nodes, edge, xi).position; };
  return {.at = [&field, s, place, uses_s](double xi) { return field(place(xi), uses_s ? s(xi) : 0); },
          .range = [&nodes, edge, &range, s, place, uses_s](double from, double to) -> std::optional<Interval> {
            if (!range.known()) return {};
            // The piece is a parabola: it lies within the triangle of its ends and of the crossing of its tangents.
            const Vec2 start = place(from), end = place(to), middle = place((from + to) / 2),
                       crossing = 2 * middle - (start + end) / 2;
            const Vec2 low = start.cwiseMin(end).cwiseMin(crossing), high = start.cwiseMax(end).cwiseMax(crossing);
            const PlaceRange box{
                {low.x(), high.x()}, {low.y(), high.y()}, between(uses_s ? s(from) : 0, uses_s ? s(to) : 0)};
            const Vec2 leaves = edge_point(nodes, edge, from).tangent, arrives = edge_point(nodes, edge, to).tangent;
            return range.along({.box = box,
                                .middle = middle,
                                .s = uses_s ? s((from + to) / 2) : 0,
                                .dx = between(leaves.x(), arrives.x()),
                                .dy = between(leaves.y(), arrives.y()),
                                .half = (to - from) / 2});
          },
          .round_off =
              [&field, &range, s, place, uses_s](double xi) {
                const Vec2 x = place(xi);
                const double along = uses_s ? s(xi) : 0, of_value = epsilon * std::abs(field(x, along));
                if (!range.known()) return of_value;
                const double moved = epsilon * x.cwiseAbs().maxCoeff();
                const Interval all =
                    range({{x.x() - moved, x.x() + moved}, {x.y() - moved, x.y() + moved}, {along, along}});
                return of_value + (all.high - all.low);
              }};
}

std::vector<double> resolving_cuts(const LineFunction& f) {
  const Sampled all = sample(f, -1, 1);
  const int count = f.range(-1, 1) ? 1 : blind_pieces;
  std::optional<double> round_off;  // where it is needed
  const auto settles = [&](const Piece& piece) {
    if (piece.error <= tolerance * f.scale) return true;
    if (!round_off) {
      round_off = 0;
      for (const double xi : all.at) round_off = std::max(*round_off, f.round_off(xi));
    }
    return piece.error <= *round_off * piece.whole.length();
  };
  std::priority_queue<Piece> pieces;
  std::vector<Sampled> settled;
  const auto add = [&](const Sampled& whole) {
    Piece piece = piece_of(f, whole);
    if (settles(piece) || whole.length() <= shortest)
      settled.push_back(whole);
    else
      pieces.push(std::move(piece));
  };
  for (int k = 0; k < count; ++k) add(count == 1 ? all : sample(f, -1 + 2. * k / count, -1 + 2. * (k + 1) / count));
  while (!pieces.empty() && pieces.size() + settled.size() < most_pieces) {
    const auto halves = pieces.top().halves;
    pieces.pop();
    for (const Sampled& half : halves) add(half);
  }
  for (; !pieces.empty(); pieces.pop()) settled.push_back(pieces.top().whole);
  Moments sum = Moments::Zero();
  for (const Sampled& piece : settled) sum += piece.moments(0, 1);
  if ((sum - all.moments(0, 1)).cwiseAbs().maxCoeff() <= std::max(tolerance * f.scale, 2 * round_off.value_or(0)))
    return {-1, 1};
  std::vector<double> cuts{-1};
  for (const Sampled& piece : settled) cuts.push_back(piece.to);
  std::ranges::sort(cuts);
  return cuts;
}

std::vector<double> merged(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> both;
  std::ranges::set_union(a, b, std::back_inserter(both));
  return both;
}

LineRule cut_rule(const std::vector<double>& cuts, int gauss_points) {
  const LineRule one = gauss_legendre(gauss_points);
  LineRule all;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    for (std::size_t q = 0; q < one.points.size(); ++q) {
      const double half = (cuts[i + 1] - cuts[i]) / 2;
      all.points.push_back(cuts[i] + half * (1 + one.points[q]));
      all.weights.push_back(half * one.weights[q]);
    }
  return all;
}

LineRule CutSides::rule(const Edge& edge) const {
  static const LineRule whole = gauss_legendre(4);
  return cuts ? cut_rule(cuts(edge), 4) : whole;
}

LineMisfit misfit(const LineFunction& f, const std::vector<double>& cuts) {
  if (cuts.size() == 2) return {};
  const LineRule all = cut_rule(cuts, rule_points);
  const std::size_t count = all.points.size();
  std::vector<double> values(count);
  Moments legendre = Moments::Zero();  // int f P_k
  const auto polynomials = [](double xi) { return Moments(1, xi, 1.5 * xi * xi - 0.5); };
  for (std::size_t q = 0; q < count; ++q) {
    values[q] = f.at(all.points[q]);
    legendre += all.weights[q] * values[q] * polynomials(all.points[q]);
  }
  const Moments coefficients = legendre.cwiseProduct(Moments(0.5, 1.5, 2.5));
  LineMisfit found;
  for (std::size_t q = 0; q < count; ++q) {
    const double difference = std::abs(values[q] - coefficients.dot(polynomials(all.points[q])));
    found.mean += all.weights[q] / 2 * difference;
    found.mean_of_f += all.weights[q] / 2 * std::abs(values[q]);
    if (difference > found.largest) {
      found.largest = difference;
      found.at = all.points[q];
    }
  }
  const auto [low, high] = std::ranges::minmax(values);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const auto first = values.begin() + std::ptrdiff_t(rule_points * i);
    const auto [least, most] = std::minmax_element(first, first + rule_points);
    if (*most - *least >= 0.1 * (high - low)) found.finest = std::min(found.finest, cuts[i + 1] - cuts[i]);
  }
  return found;
}

}  // namespace mortise
