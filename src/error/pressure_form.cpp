#include "error/pressure_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "error/banded_fit.hpp"
#include "fem/quadrature.hpp"

namespace mortise {
namespace {

constexpr int order = 10;   // points on an edge: r^(1/2) and graded r^(exponent - 1) to 1e-10 of the edge's force
constexpr int reach = 22;   // edges beyond the clear ones that a border feels: what a knot does falls by 3.7 an edge
constexpr int places = 16;  // of the border on two edges, of which the best is refined: there are several minima
constexpr int parabolas =
    3;  // through the misfits beside it, each an eighth as wide: it varies smoothly with the moments

double power(double x, double exponent) {
  if (exponent == 1) return 1;
  return exponent == 1.5 ? std::sqrt(x) : std::pow(x, exponent - 1);
}

// The powers of both ends, lengths over that of the piece. About a mirror the other end's has its image. `r`: the
// distances from both centres, which s does not tell near them.
double weight(const std::array<PieceEnd, 2>& ends, double s, const std::array<double, 2>& r) {
  const double length = ends[1].place - ends[0].place;
  double product = 1;
  for (const int k : {0, 1}) {
    const PieceEnd &end = ends[k], &other = ends[1 - k];
    if (end.exponent == 1) continue;
    product *= power(r[k] / length, end.exponent);
    if (other.mirrored) product *= power(std::abs(s - 2 * other.place + end.centre) / length, end.exponent);
  }
  return product;
}

// Every so many of the vertices between the ends, but those next to an end: as many coefficients as moments are known.
std::vector<double> breaks(const LoadedPiece& piece, const FormSpec& spec) {
  const auto& [start, end] = piece.ends;
  std::vector<double> v{start.place};
  for (const double s : piece.s)
    if (s > start.place && s < end.place) v.push_back(s);
  v.push_back(end.place);
  const auto skipped = [&](const PieceEnd& at, bool joined) { return at.border ? spec.clear : joined ? 3 : 2; };
  const std::size_t first = skipped(start, piece.joined.front()), last = skipped(end, piece.joined.back());
  std::vector<double> kept{v.front()};
  for (std::size_t i = first; i + last < v.size(); i += spec.every) kept.push_back(v[i]);
  kept.push_back(v.back());
  return kept;
}

// The moments of the splines that are not zero on an edge, with the hats of its start and of its end.
struct EdgeMoments {
  int first = 0;  // column
  std::array<double, 4> start{}, end{};
};

struct Columns {
  const Knots& knots;
  int merged_start, merged_end;  // the two splines at a mirror are one: the slope there is 0
  int count() const { return knots.count() - merged_start - merged_end; }
  int of(int spline) const { return std::clamp(spline - merged_start, 0, count() - 1); }
};

// Points and weights on [0, 1] for a smooth function times x^(exponent - 1).
struct Graded {
  std::array<double, order> t, w;
};

Graded graded(double exponent) {
  static const LineRule rule = gauss_legendre(order);
  const double grade = exponent == 1 ? 1 : exponent > 1 ? 2 : 2 / exponent;
  Graded g;
  for (int i = 0; i < order; ++i) {
    const double x = (1 + rule.points[i]) / 2;
    g.t[i] = std::pow(x, grade);
    g.w[i] = grade * std::pow(x, grade - 1) * rule.weights[i] / 2;
  }
  return g;
}

class Fit {
 public:
  Fit(const LoadedPiece& piece, const FormSpec& spec)
      : piece_(piece),
        form_{piece.ends, clamped_knots(spec.degree, breaks(piece, spec)), {}},
        columns_{form_.knots, piece.ends[0].mirrored, piece.ends[1].mirrored} {
    integrate();
    add_up();
  }

  // `open`: nothing is known of the last vertex' moment, nor so of the whole force.
  PressureForm form(bool open) {
    solve(open);
    return std::move(form_);
  }

  // Sum of squares of the forces up to each vertex that p* does not have.
  double misfit() {
    solve(true);
    if (form_.q.size() == 0) return std::numeric_limits<double>::infinity();
    double sum = 0;
    for (Eigen::Index i = 0; i < Eigen::Index(rows_.size()); ++i) {
      const double left = rows_[i].row.dot(forces_.segment(rows_[i].first, rows_[i].row.size())) - summed_(i);
      sum += (scale_(i) * left) * (scale_(i) * left);
    }
    return sum;
  }

 private:
  // Of the force up to a vertex the entries in those up to each spline.
  struct Row {
    Eigen::Index first = 0;
    VecX row;
  };

  void integrate() {
    const auto& s = piece_.s;
    const auto& [start, end] = piece_.ends;
    static const Graded plain = graded(1);
    const Graded at_start = graded(start.centre == start.place ? start.exponent : 1),
                 at_end = graded(end.centre == end.place ? end.exponent : 1);
    edges_.resize(s.size() - 1);
    totals_ = VecX::Zero(columns_.count());
    for (Eigen::Index e = 0; e + 1 < s.size(); ++e) {
      const double from = std::max(s(e), start.place), to = std::min(s(e + 1), end.place), length = to - from;
      if (!(length > 0)) continue;
      const bool reversed = from != start.place && to == end.place;
      const Graded& rule = from == start.place ? at_start : reversed ? at_end : plain;
      EdgeMoments& m = edges_[e].emplace();
      m.first = columns_.of(splines_at(form_.knots, (from + to) / 2).first);
      for (int i = 0; i < order; ++i) {
        const double x = reversed ? to - length * rule.t[i] : from + length * rule.t[i];
        const double z = (x - s(e)) / (s(e + 1) - s(e));
        const double depth = (1 - z) * piece_.depth(e) + z * piece_.depth(e + 1);
        std::array<double, 2> r{std::abs(x - start.centre), std::abs(x - end.centre)};
        if (&rule == &at_start && start.centre == from) r[0] = length * rule.t[i];
        if (&rule == &at_end && end.centre == to) r[1] = length * rule.t[i];
        const double f = length * rule.w[i] * depth * weight(piece_.ends, x, r);
        const SplineValues values = splines_at(form_.knots, x);
        for (int k = 0; k <= form_.knots.degree; ++k) {
          const int column = columns_.of(values.first + k);
          m.start[column - m.first] += f * values.value[k] * (1 - z);
          m.end[column - m.first] += f * values.value[k] * z;
          totals_(column) += f * values.value[k];
        }
      }
    }
  }

  // With the force up to spline k as unknown k, the force up to vertex i has a few entries: splines before the edge
  // after it have all of theirs, splines beyond none.
  void add_up() {
    const Eigen::Index count = Eigen::Index(edges_.size()), last = columns_.count() - 1;
    VecX passed = VecX::Zero(columns_.count());
    rows_.resize(count);
    scale_.resize(count);
    summed_.resize(count);
    const double least_depth = 1e-3 * piece_.depth.maxCoeff();
    double force = 0;
    bool before = true;
    for (Eigen::Index i = 0; i < count; ++i) {
      force += piece_.moments(i);
      summed_(i) = force;
      const double h = (piece_.s(i + 1) - piece_.s(std::max<Eigen::Index>(i - 1, 0))) / 2;
      scale_(i) = 1 / std::sqrt(h * std::max(piece_.depth(i), least_depth));
      if (!edges_[i]) {
        rows_[i] = before ? Row{0, VecX()} : Row{last, VecX::Ones(1)};
        continue;
      }
      before = false;
      const EdgeMoments& m = *edges_[i];
      const int to = std::min<int>(m.first + form_.knots.degree, int(last)), from = std::max(m.first - 1, 0);
      VecX row = VecX::Zero(to - from + 1);
      if (from < m.first) row(0) = 1;
      for (int k = m.first; k <= to; ++k) {
        const double part = (passed(k) + m.start[k - m.first]) / totals_(k);
        row(k - from) += part;
        if (k > 0) row(k - 1 - from) -= part;
        passed(k) += m.start[k - m.first] + m.end[k - m.first];
      }
      rows_[i] = {from, row};
    }
  }

  void solve(bool open) {
    const Eigen::Index all = columns_.count(), count = open ? all : all - 1;
    const double whole = piece_.moments.sum();
    BandedFit fit(count, form_.knots.degree + 2);
    VecX lever = VecX::Zero(all);
    double lever_value = 0;
    for (Eigen::Index i = 0; i < Eigen::Index(rows_.size()); ++i) {
      const Row& r = rows_[i];
      const double h = piece_.s(i + 1) - piece_.s(i);
      lever.segment(r.first, r.row.size()) += h * r.row;
      lever_value += h * summed_(i);
      const Eigen::Index own = std::min(r.row.size(), count - r.first);
      if (own <= 0 || piece_.joined[i]) continue;
      const double known = own < r.row.size() ? r.row(own) * whole : 0;
      fit.add(r.first, scale_(i) * r.row.head(own), scale_(i) * (summed_(i) - known));
    }
    const VecX found = open ? fit.solve() : fit.solve(lever.head(count), lever_value - lever(count) * whole);
    form_.q.resize(0);
    if (found.size() != count || !found.allFinite()) return;
    forces_ = found;
    if (!open) forces_ = stacked(found, VecX::Constant(1, whole));
    form_.q.resize(form_.knots.count());
    for (int j = 0; j < form_.knots.count(); ++j) {
      const int k = columns_.of(j);
      form_.q(j) = (forces_(k) - (k > 0 ? forces_(k - 1) : 0)) / totals_(k);
    }
  }

  const LoadedPiece& piece_;
  PressureForm form_;
  Columns columns_;
  std::vector<std::optional<EdgeMoments>> edges_;  // none: no part of p* is on it
  VecX totals_;                                    // of each column
  std::vector<Row> rows_;                          // of each vertex but the last
  VecX scale_, summed_, forces_;
};

LoadedPiece reversed(const LoadedPiece& piece) {
  LoadedPiece r{.s = -piece.s.reverse(),
                .depth = piece.depth.reverse(),
                .moments = piece.moments.reverse(),
                .joined = {piece.joined.rbegin(), piece.joined.rend()},
                .ends = {piece.ends[1], piece.ends[0]}};
  for (PieceEnd& end : r.ends) {
    end.place = -end.place;
    end.centre = -end.centre;
  }
  return r;
}

// Its first edges, of which the last vertex has a part of its moment only; all of it where it has no more.
LoadedPiece beginning(const LoadedPiece& piece, Eigen::Index edges) {
  if (edges >= piece.s.size() - 1) return piece;
  LoadedPiece r{.s = piece.s.head(edges + 1),
                .depth = piece.depth.head(edges + 1),
                .moments = piece.moments.head(edges + 1),
                .joined = {piece.joined.begin(), piece.joined.begin() + edges},
                .ends = piece.ends};
  r.joined.back() = 0;
  r.ends[1] = {.place = r.s(edges), .centre = r.s(edges)};
  return r;
}

// Of a piece that starts at a border.
double border_place(const LoadedPiece& whole, const FormSpec& spec) {
  LoadedPiece piece = beginning(whole, spec.clear + reach);
  const auto misfit = [&](double z) {
    piece.ends[0].place = piece.ends[0].centre = z;
    return Fit(piece, spec).misfit();
  };
  const double first = piece.s(0), step = (piece.s(2) - first) / places;
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= places; ++i)
    if (const double found = misfit(first + i * step); found < least) {
      least = found;
      best = i;
    }
  double at = first + best * step, d = step;
  for (int i = 0; i < parabolas; ++i, d /= 8) {
    at = std::clamp(at, first + d, first + places * step - d);
    const double before = misfit(at - d), here = misfit(at), after = misfit(at + d);
    const double bend = before - 2 * here + after;
    if (!(bend > 0)) continue;
    at += d * std::clamp((before - after) / (2 * bend), -1.0, 1.0);
  }
  return at;
}

}  // namespace

double PressureForm::at(double s) const {
  if (s < ends[0].place || s > ends[1].place) return 0;
  const SplineValues values = splines_at(knots, s);
  double sum = 0;
  for (int k = 0; k <= knots.degree; ++k) sum += values.value[k] * q(values.first + k);
  return sum * weight(ends, s, {std::abs(s - ends[0].centre), std::abs(s - ends[1].centre)});
}

PressureForm fit_form(const LoadedPiece& piece, const FormSpec& spec) { return Fit(piece, spec).form(false); }

void place_borders(LoadedPiece& piece, const FormSpec& spec) {
  const auto put = [](PieceEnd& end, double place) { end.place = end.centre = place; };
  const Eigen::Index last = piece.s.size() - 1;
  if (piece.ends[0].border) put(piece.ends[0], piece.s(1));
  if (piece.ends[1].border) put(piece.ends[1], piece.s(last - 1));
  const bool both = piece.ends[0].border && piece.ends[1].border && last < spec.clear + reach;
  for (int pass = 0; pass < (both ? 2 : 1); ++pass) {
    if (piece.ends[0].border) put(piece.ends[0], border_place(piece, spec));
    if (piece.ends[1].border) put(piece.ends[1], -border_place(reversed(piece), spec));
  }
}

}  // namespace mortise
