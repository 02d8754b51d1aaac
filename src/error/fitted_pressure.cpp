#include "error/fitted_pressure.hpp"

#include <algorithm>

#include "error/goal_estimate.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

using Eigen::Index;

constexpr double whole_edge = 1e-6;     // of an edge's length, that it may lack of facing the other side all along
constexpr double same_place = 1e-9;     // of the line's length
constexpr double credible_part = 0.95;  // of the vertices: bars are made to hold at so many
// Of swings of p* over those of p_h, squares. p_h has S of a smooth p and N of noise, of which p* makes S and a N. At
// the vertices p_h is off by S / 12 and N / 4, p* by a N / 4: it is nearer only if (a^2 - 1) N^2 < S^2 / 9.
constexpr double most_swing = 10. / 9;
constexpr Index least_edges = 4;     // of a piece: a cubic has as many coefficients
constexpr int tension_places = 200;  // along a piece, at which p* is looked at
// Edges beside an end over which p_h swings, as they see contact end at a vertex: +9, -4, -36 % over the last five of
// Hertz' pressure; as many at the tip of a crack that slides. Fewer if waves of p leave no cubic over ten.
constexpr std::array swing_edges{10, 6, 4};
// At the tip of a crack the swings are the larger, the shorter the edges, and p is as smooth there as elsewhere: the
// cubic goes on over so much of the piece, if waves of p leave it.
constexpr std::array smooth_parts{1.0, 0.25, 0.0625, 0.015625, 0.0};

enum class Facing { none, part, whole };

// Vertices one after another, on a closed curve from one at which p may be cut.
struct Walk {
  std::vector<Index> vertex;  // of the line
  VecX s, p;                  // p: 0 where it is none
  std::vector<char> carries;
  std::vector<Facing> facing;               // of each edge
  std::vector<const SingularPoint*> point;  // at each vertex, where the form of p is known; else null

  Index edges() const { return Index(facing.size()); }
  bool loaded(Index e) const { return carries[e] && carries[e + 1] && facing[e] == Facing::whole; }
  bool cut(Index v) const { return point[v] != nullptr; }
  bool swings(Index v) const { return cut(v) && point[v]->is_swinging(); }
};

std::vector<Facing> facings(const Mesh& mesh, const ContactPair& pair) {
  VecX faced = VecX::Zero(Index(pair.multiplier.edges.size()));
  for (const ContactPoint& point : pair.points) faced(point.edge) += point.ds;
  std::vector<Facing> all;
  for (Index e = 0; e < faced.size(); ++e) {
    const bool whole = faced(e) > (1 - whole_edge) * edge_length(mesh.nodes, pair.multiplier.edges[e]);
    all.push_back(whole ? Facing::whole : faced(e) > 0 ? Facing::part : Facing::none);
  }
  return all;
}

// Of each vertex the singular point that is there, or that it faces; else null.
std::vector<const SingularPoint*> points_at_vertices(const PressureEstimate& estimate) {
  const PressureLine& line = estimate.line;
  const Index last = line.p.size() - 1;
  std::vector<const SingularPoint*> points(last + 1, nullptr);
  for (const SingularPoint& point : estimate.singular) {
    const Vec2 foot = line.foot(point.position);
    for (Index i = 0; i <= last; ++i)
      if (!points[i] && (foot - line.position[i]).norm() < same_place * line.s(last)) points[i] = &point;
  }
  return points;
}

Walk walk_along(const Mesh& mesh, const ContactPair& pair, const PressureEstimate& estimate) {
  const PressureLine& line = estimate.line;
  const Index last = line.p.size() - 1;
  const double least = loaded_part * largest_entry(line.p);
  const bool bilateral = pair.spec.condition == Condition::bilateral;
  const std::vector<const SingularPoint*> points = points_at_vertices(estimate);
  const auto carries = [&](Index i) {  // p_h may be zero where it swings
    return bilateral ? line.loaded[i] != 0 : line.p(i) > least || (line.loaded[i] && estimate.swings[i]);
  };
  // Where the line is cut or open, and best not next to a piece, which has vertices beyond its border.
  Index start = 0;
  for (Index i = 0; line.closed && i < last; ++i)
    if (!carries(i) || points[i]) start = i;
  for (Index i = 0; line.closed && i < last; ++i)
    if (!carries(i) && !carries((i + 1) % last) && !carries((i + last - 1) % last)) start = i;
  const std::vector<Facing> facing = facings(mesh, pair);
  Walk walk{.vertex = {}, .s = VecX(last + 1), .p = VecX(last + 1), .carries = {}, .facing = {}, .point = {}};
  for (Index k = 0; k <= last; ++k) {
    const Index i = line.closed ? (start + k) % last : k;
    walk.vertex.push_back(i);
    walk.s(k) = line.s(i) + (start + k >= last && line.closed ? line.s(last) : 0);
    walk.carries.push_back(carries(i));
    walk.p(k) = walk.carries[k] ? line.p(i) : 0;
    walk.point.push_back(points[i]);
    if (k < last) walk.facing.push_back(facing[i % last]);
  }
  return walk;
}

// Vertices of the walk.
struct Range {
  Index first, last;  // that carry p
  std::array<PieceEnd, 2> end;
};

// How a piece ends at vertex v, beyond which edge e is; nothing where that faces the other side in part: its moments
// are no hat functions'.
std::optional<PieceEnd> end_at(const Walk& walk, Index v, Index e) {
  if (walk.cut(v)) {
    const SingularPoint& point = *walk.point[v];
    return PieceEnd{.power = point.small_power != 0 ? point.small_power : point.pressure_exponent - 1,
                    .tip = point.is_swinging()};
  }
  if (e < 0 || e >= walk.edges() || walk.facing[e] == Facing::none) return PieceEnd{};
  if (walk.facing[e] == Facing::part || walk.carries[e == v ? v + 1 : v - 1]) return std::nullopt;
  return PieceEnd{.power = 0.5, .border = true};
}

std::vector<Range> loaded_ranges(const Walk& walk) {
  std::vector<Range> ranges;
  for (Index e = 0; e < walk.edges();) {
    Index last = e;
    while (last < walk.edges() && walk.loaded(last) && (last == e || !walk.cut(last))) ++last;
    if (last - e >= least_edges) {
      const auto start = end_at(walk, e, e - 1), end = end_at(walk, last, last);
      if (start && end) ranges.push_back({e, last, {*start, *end}});
    }
    e = std::max(last, e + 1);
  }
  return ranges;
}

// With the vertices beyond borders.
LoadedPiece piece_of(const Walk& walk, const Range& range, const PressureLine& line, bool rings) {
  constexpr Index beyond = 2;
  const auto carries_none = [&](Index v, Index e) {
    return e >= 0 && e < walk.edges() && walk.facing[e] == Facing::whole && !walk.carries[v];
  };
  Index first = range.first, last = range.last;
  while (range.end[0].border && range.first - first < beyond && carries_none(first - 1, first - 1)) --first;
  while (range.end[1].border && last - range.last < beyond && carries_none(last + 1, last)) ++last;
  const Index count = last - first + 1;
  LoadedPiece piece{.s = walk.s.segment(first, count),
                    .p = walk.p.segment(first, count),
                    .width = VecX::Ones(count),
                    .end = range.end};
  for (Index k = 0; rings && k < count; ++k) {
    const double x = line.position[walk.vertex[first + k]].x();
    piece.width(k) = x > same_place * (walk.s(last) - walk.s(first)) ? x : 0;
  }
  for (const int which : {0, 1}) {
    const Index v = which == 0 ? range.first : range.last;
    piece.end[which].even = piece.width(which * (count - 1)) == 0 && !walk.cut(v);
  }
  return piece;
}

std::array<double, 2> ends_of(const LoadedPiece& piece) {
  std::array<double, 2> ends;
  for (const int which : {0, 1})
    ends[which] = piece.end[which].border ? border_place(piece, which) : piece.s(which * (piece.s.size() - 1));
  return ends;
}

// Nothing where it is not the same all along: p less a part that falls along the piece is no form that is known.
std::optional<double> fluid_beside(const Walk& walk, const Range& range, const PressureLine& line) {
  if (line.fluid.size() == 0) return 0.0;
  const double fluid = line.fluid(walk.vertex[range.first]);
  for (Index k = range.first; k <= range.last; ++k)
    if (line.fluid(walk.vertex[k]) != fluid) return std::nullopt;
  return fluid;
}

// How much a function's slopes jump at the vertices inside a range, which ends leave alone: int of the squares of what
// swings from vertex to vertex, but for a factor.
template <typename Function>
double swing_of(const Walk& walk, const Range& range, const PressureEstimate& estimate, Function p) {
  constexpr Index beside = 2;
  double sum = 0;
  for (Index k = range.first + beside; k <= range.last - beside; ++k) {
    if (!estimate.counts(walk.vertex[k])) continue;
    const double before = walk.s(k) - walk.s(k - 1), after = walk.s(k + 1) - walk.s(k), h = (before + after) / 2;
    const double jump = (p(k + 1) - p(k)) / after - (p(k) - p(k - 1)) / before;
    sum += h * h * h * jump * jump;
  }
  return sum;
}

// `missed`: at each vertex of the line what p_h may miss along it.
bool credible(const PressureForm& form, const Walk& walk, const Range& range, const PressureEstimate& estimate,
              const VecX& missed, bool unilateral) {
  int counted = 0, within = 0;
  for (Index k = range.first; k <= range.last; ++k) {
    const Index i = walk.vertex[k];
    if (!estimate.counts(i)) continue;
    ++counted;
    const double p = form(walk.s(k));
    within += std::abs(p - walk.p(k)) <= missed(i);
    if (unilateral && p < 0) return false;
  }
  if (!(within >= credible_part * counted)) return false;
  const double swing = swing_of(walk, range, estimate, [&](Index k) { return form(walk.s(k)); });
  if (swing > most_swing * swing_of(walk, range, estimate, [&](Index k) { return walk.p(k); })) return false;
  const auto [from, to] = form.ends();
  for (int k = 1; unilateral && k < tension_places; ++k)
    if (!(form(from + (to - from) * k / tension_places) >= 0)) return false;
  return true;
}

// p* as it would be of a mesh with every other vertex: of its moments, which are sums of the piece's.
std::optional<PressureForm> fit_of_every_other(const LoadedPiece& piece, PressureFits& fits) {
  std::array<double, 2> ends = ends_of(piece);
  for (const int which : {0, 1})
    if (piece.end[which].border) ends[which] = border_place(piece, which, 2);
  LoadedPiece coarse = every_other(piece);
  for (coarse.swing.edges = (piece.swing.edges + 1) / 2; coarse.swing.edges >= 2; --coarse.swing.edges)
    if (auto form = fits.fit(coarse, ends)) return form;
  return std::nullopt;
}

// The longest first.
std::vector<Swing> swings_to_try(const Range& range) {
  const auto any = [&](auto has) { return has(range.end[0]) || has(range.end[1]); };
  std::vector<Swing> all;
  if (any([](const PieceEnd& end) { return end.tip; }))
    for (const double part : smooth_parts) all.push_back({swing_edges[0], part});
  if (all.empty()) all.push_back({swing_edges[0], 0});
  if (any([](const PieceEnd& end) { return end.tip || end.border; }))
    for (std::size_t k = 1; k < swing_edges.size(); ++k) all.push_back({swing_edges[k], 0});
  return all;
}

// p* is at least as near as it would be of every other vertex: by as much as that is off from it, what p_h misses along
// the line is lowered.
void lower_errors(const Walk& walk, const Range& range, const PressureForm& form, const PressureForm& coarse,
                  PressureEstimate& e) {
  const PressureLine& line = e.line;
  LineError& local = e.local;
  const VecX missed = local.pointwise(line);
  double worst = 0, square = 0, of_multiplier = 0;
  for (Index k = range.first; k <= range.last; ++k) {
    const Index i = walk.vertex[k];
    if (!e.counts(i)) continue;
    if (local.border[i]) continue;
    const double off = std::abs(form(walk.s(k)) - coarse(walk.s(k)));
    if (off > 0) worst = largest(worst, off / missed(i));
    square += off * off * line.h(i);
    of_multiplier += std::pow(std::max(local.l2(i), local.swing(i)), 2);
  }
  const double norm = std::sqrt(square / of_multiplier);
  if (!(norm < 1)) return;
  for (Index k = range.first; k <= range.last; ++k) {
    const Index i = walk.vertex[k];
    const bool known = !walk.cut(k) || (walk.swings(k) && (k == 0 || k > range.first));  // once where two pieces meet
    if (!known || local.border[i]) continue;
    local.l2(i) *= norm;
    local.swing(i) *= norm;
    local.worst(i) = std::max(1.0, std::min(worst, 1.0) / norm);
  }
  if (!line.closed) return;
  for (VecX* each : {&local.l2, &local.swing, &local.worst}) (*each)(each->size() - 1) = (*each)(0);
}

// How much p* swings beside an end: squares of what its slopes jump by, over half an edge before and after each vertex
// and middle of an edge, times that length, so that each edge counts as another, however short.
double swing_beside(const PressureForm& form, const LoadedPiece& piece, int which) {
  const Index last = piece.s.size() - 1;
  const auto vertex = [&](Index k) { return piece.s(which == 0 ? k : last - k); };
  const auto at = [&](Index k) { return (vertex(k / 2) + vertex((k + 1) / 2)) / 2; };
  double sum = 0;
  for (Index k = 2; k < last; ++k) {  // not from the end, at which p* may be infinite
    const double before = at(k) - at(k - 1), after = at(k + 1) - at(k);
    const double jump = (form(at(k + 1)) - form(at(k))) / after - (form(at(k)) - form(at(k - 1))) / before;
    sum += std::pow(jump * (before + after) / 2, 2);
  }
  return sum;
}

// Each border of the piece lies where its p* ends.
void place_borders(const LoadedPiece& piece, const std::array<double, 2>& ends, const PressureLine& line,
                   LineError& local) {
  const double around = line.s(line.s.size() - 1);
  for (const int which : {0, 1}) {
    if (!piece.end[which].border) continue;
    const double s = line.closed ? std::fmod(ends[which], around) : ends[which];
    for (LineError::Border& border : local.borders)
      if (line.s(border.edge) <= s && s <= line.s(border.edge + 1)) border.place = s;
  }
}

// The share of p that goes as the power of a singular point may be none, as where other bodies close the corner: then
// no q is smooth, and p* with q alone is the smoother one beside that end.
template <typename Credible>
void leave_powers(const std::array<double, 2>& ends, Credible credible, PressureFits& fits, LoadedPiece& piece,
                  PressureForm& form) {
  for (const int which : {0, 1}) {
    if (piece.end[which].border || piece.end[which].power == 0) continue;
    LoadedPiece plain = piece;
    plain.end[which].power = 0;
    const auto other = fits.fit(plain, ends);
    if (!other || !credible(*other) || swing_beside(*other, piece, which) >= swing_beside(form, piece, which)) continue;
    form = *other;
    piece = plain;
  }
}

}  // namespace

void find_fitted_pressure(const Problem& problem, const ContactPair& pair, PressureFits& fits,
                          PressureEstimate& estimate) {
  fits.begin();
  const PressureLine& line = estimate.line;
  FittedPressure& fitted = estimate.fitted;
  fitted = {.pieces = {}, .around = line.closed ? line.s(line.s.size() - 1) : 0};
  if (problem.method.multipliers != Multipliers::linear || pair.spec.stiffness || !(largest_entry(line.p) > 0)) return;
  const Walk walk = walk_along(problem.mesh, pair, estimate);
  const bool unilateral = pair.spec.condition == Condition::unilateral;
  const VecX missed = error_safety * estimate.local.pointwise(line);
  for (const Range& range : loaded_ranges(walk)) {
    const std::optional<double> fluid = fluid_beside(walk, range, line);
    if (!fluid) continue;
    LoadedPiece piece = piece_of(walk, range, line, problem.discretisation.system.constraints.rings);
    const std::array<double, 2> ends = ends_of(piece);
    for (const Swing& swing : swings_to_try(range)) {
      piece.swing = swing;
      auto form = fits.fit(piece, ends);
      const auto is_credible = [&](const PressureForm& found) {
        return credible(found, walk, range, estimate, missed, unilateral);
      };
      if (!form || !is_credible(*form)) continue;
      leave_powers(ends, is_credible, fits, piece, *form);
      fitted.pieces.push_back({*form, {piece.s(0), piece.s(piece.s.size() - 1)}, *fluid});
      place_borders(piece, ends, line, estimate.local);
      if (const auto coarse = fit_of_every_other(piece, fits)) lower_errors(walk, range, *form, *coarse, estimate);
      break;
    }
  }
}

}  // namespace mortise
