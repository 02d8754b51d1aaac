#include "error/pressure_bars.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "error/goal_estimate.hpp"

namespace mortise {
namespace {

// The windows before and after a vertex, and by how much it belongs to the latter: linear between their centres, the
// nearest alone beyond them, around a closed line from the last one to the first.
struct Between {
  int before, after;
  double part;
};

Between windows_beside(const PressureEstimate& e, Eigen::Index i) {
  const double s = e.line.s(i);
  const int count = int(e.windows.size());
  int k = 0;
  while (k < count && e.windows[k].s < s) ++k;
  const int before = k > 0 || e.line.closed ? (k + count - 1) % count : 0,
            after = k < count || e.line.closed ? k % count : count - 1;
  const double from = e.line.distance(e.windows[before].s, s), to = e.line.distance(s, e.windows[after].s);
  return {before, after, from + to > 0 ? from / (from + to) : 0};
}

// At a vertex; of what corners nearby do each by its shape.
double between_windows(const PressureEstimate& e, Eigen::Index i) {
  if (e.windows.empty()) return 0;
  const auto [before, after, part] = windows_beside(e, i);
  double far = (1 - part) * e.far(before) + part * e.far(after);
  for (const LocalTail& tail : e.tails.local) {
    if (tail.window == before) far += (1 - part) * tail.at(e.line.position[i]);
    if (tail.window == after && after != before) far += part * tail.at(e.line.position[i]);
  }
  return far;
}

// The distance from a border at which what moves it is what the nearest window tells.
double centre_of_window(const PressureEstimate& e, const LineError::Border& border) {
  const double open = e.line.s(open_vertex(e.line, border));
  const auto from_border = [&](const PressureWindow& window) { return e.line.distance(window.s, open); };
  const PressureWindow& nearest = *std::ranges::min_element(e.windows, {}, from_border);
  return nearest.from_border > 0 ? nearest.from_border : from_border(nearest);
}

// What the bodies' errors make of p at a vertex, stress: at most, and as a mean over where in its edge a border may be.
struct FarError {
  double most, mean;
};

// Where they move a border of contact, by d, they change p = c sqrt(r) beside it by c d / (2 sqrt(r)), and by c sqrt(d)
// at most: that between the border and the window nearest to it (docs/theory.md eq. 48e).
FarError far_at(const PressureEstimate& e, Eigen::Index i) {
  const PressureLine& line = e.line;
  const double far = between_windows(e, i);
  FarError found{far, far};
  if (!(far > 0)) return found;
  for (const LineError::Border& border : e.local.borders) {
    const double open = line.s(open_vertex(line, border)), centre = centre_of_window(e, border);
    if (line.distance(line.s(i), open) > centre) continue;
    const double quarter = far * std::sqrt(centre) / (2 * border.root),
                 r = std::max(line.distance(line.s(i), open), quarter);
    found.most = std::max(found.most, far * std::sqrt(centre / r));
    found.mean = std::max(found.mean, far * std::sqrt(centre / std::max(r, line.h(i) / 2)));
  }
  return found;
}

// At vertices beyond a border that it may move to the p that it brings, c sqrt(d - r), of which the safety factor makes
// a motion by its square.
void add_beyond(const LineError::Border& border, double moved, PressureEstimate& e) {
  const PressureLine& line = e.line;
  const double safe = error_safety * error_safety * moved;
  const Eigen::Index open = open_vertex(line, border);
  const int step = open == border.edge ? -1 : 1;
  Eigen::Index i = open;
  for (Eigen::Index left = line.p.size() - 1; left > 0; --left) {
    const auto next = line.beside(i, step);
    if (!next) break;
    i = *next;
    if (!line.faced[line.edge_to(i, step)] || line.p(i) != 0) break;
    const double beyond = line.distance(line.s(i), line.s(open));
    if (beyond >= safe) break;
    const double p = border.root * std::sqrt(safe - beyond);
    e.bar(i) = std::max(e.bar(i), p);
    if (!line.loaded[i] && !e.excluded[i]) e.far2 += p * p / (error_safety * error_safety) * line.h(i);
  }
}

// The pieces of a line that are loaded, each by itself.
struct LoadedPieces {
  std::vector<int> of_edge;        // -1: none
  std::vector<double> length;      // of each
  std::vector<int> without_limit;  // of each, on how many sides of points where p has none it is loaded

  // That at a vertex, else the nearest.
  int at(const PressureLine& line, Eigen::Index vertex) const {
    double away = std::numeric_limits<double>::infinity();
    int nearest = -1;
    for_each_vertex([&](Eigen::Index i, int piece) {
      if (!(line.distance(line.s(i), line.s(vertex)) < away)) return;
      away = line.distance(line.s(i), line.s(vertex));
      nearest = piece;
    });
    return nearest;
  }
  template <typename Visit>
  void for_each_vertex(const Visit& visit) const {
    for (std::size_t e = 0; e < of_edge.size(); ++e)
      for (const Eigen::Index end : {Eigen::Index(e), Eigen::Index(e) + 1})
        if (of_edge[e] >= 0) visit(end, of_edge[e]);
  }
};

LoadedPieces loaded_pieces(const PressureEstimate& e) {
  const PressureLine& line = e.line;
  const Eigen::Index edges = line.p.size() - 1;
  LoadedPieces pieces{std::vector<int>(edges, -1), {}, {}};
  for (Eigen::Index i = 0; i < edges; ++i) {
    if (!line.loaded[i] || !line.loaded[i + 1]) continue;
    if (i == 0 || pieces.of_edge[i - 1] < 0) pieces.length.push_back(0);
    pieces.of_edge[i] = int(pieces.length.size()) - 1;
    pieces.length.back() += line.s(i + 1) - line.s(i);
  }
  const int last = edges > 0 ? pieces.of_edge.back() : -1;
  if (line.closed && last > 0 && pieces.of_edge.front() == 0) {  // it goes on over the seam
    pieces.length[0] += pieces.length[last];
    std::ranges::replace(pieces.of_edge, last, 0);
  }
  pieces.without_limit.assign(pieces.length.size(), 0);
  for (const SingularPoint& point : e.singular) {
    if (!point.is_unbounded()) continue;
    const Eigen::Index at = line.nearest(point.position);
    for (const int step : {-1, 1})
      if (const auto next = line.beside(at, step); next && line.loaded[at] && line.loaded[*next])
        ++pieces.without_limit[pieces.of_edge[line.edge_to(*next, step)]];
  }
  return pieces;
}

double force_along(const PressureLine& line) { return line.h.dot(line.p.cwiseAbs()); }

// Whether p is known better than to its own size.
bool is_known(const PressureEstimate& e, Eigen::Index i) { return std::abs(e.line.whole(i)) > e.local.least(i); }

}  // namespace

double border_motion(const PressureEstimate& e, const LineError::Border& border) {
  if (e.windows.empty()) return 0;
  const double far = between_windows(e, open_vertex(e.line, border));
  return 2 * far * std::sqrt(centre_of_window(e, border)) / border.root;
}

double negligible_force(const std::vector<PressureEstimate>& pressures, const AccuracySpec& spec) {
  double sum = 0;
  for (const PressureEstimate& e : pressures) sum += force_along(e.line);
  return seen_of_asked * spec.value * sum;
}

void find_excluded(double part, double negligible, PressureEstimate& e) {
  const PressureLine& line = e.line;
  e.left_out.assign(e.singular.size(), 0);
  e.excluded.assign(line.p.size(), 0);
  const LoadedPieces pieces = loaded_pieces(e);
  std::vector<int> piece_of(e.singular.size(), -1);
  for (std::size_t k = 0; k < e.singular.size(); ++k) {
    const SingularPoint& point = e.singular[k];
    const int piece = piece_of[k] = pieces.at(line, line.nearest(point.position));
    if (!point.is_unbounded() || piece < 0) continue;
    e.left_out[k] = part * pieces.length[piece] * std::min(1.0, 2.0 / std::max(pieces.without_limit[piece], 1));
    const Vec2 foot = line.foot(point.position);
    for (Eigen::Index i = 0; i < line.p.size(); ++i)
      if ((line.position[i] - foot).norm() < e.left_out[k]) e.excluded[i] = 1;
  }
  const double force = force_along(line);
  if (force > 0 && force < negligible && std::ranges::any_of(e.singular, &SingularPoint::is_unbounded)) {
    e.excluded.assign(line.p.size(), 1);
    e.local.border.assign(line.p.size(), 0);
    return;
  }
  // A mesh too coarse to tell what is near such a point from the rest of its piece: all of that counts.
  std::vector<char> left(pieces.length.size(), 0);
  pieces.for_each_vertex([&](Eigen::Index i, int piece) {
    left[piece] = left[piece] || (line.p(i) != 0 && !e.excluded[i] && is_known(e, i));
  });
  pieces.for_each_vertex([&](Eigen::Index i, int piece) { e.excluded[i] = e.excluded[i] && left[piece]; });
  for (std::size_t k = 0; k < e.singular.size(); ++k)
    if (piece_of[k] >= 0 && !left[piece_of[k]]) e.left_out[k] = 0;
  // Where contact ends in what is left out, p is a root of nothing beyond.
  for (Eigen::Index i = 0; i < line.p.size(); ++i) e.local.border[i] = e.local.border[i] && !e.excluded[i];
}

void find_window_lengths(PressureEstimate& e) {
  if (e.windows.empty()) return;
  for (PressureWindow& window : e.windows) window.length = 0;
  for (Eigen::Index i = 0; i < e.line.p.size(); ++i) {
    if (!e.counts(i)) continue;
    const auto [before, after, part] = windows_beside(e, i);
    e.windows[before].length += (1 - part) * e.line.h(i);
    e.windows[after].length += part * e.line.h(i);
  }
}

void find_bars(PressureEstimate& e) {
  const PressureLine& line = e.line;
  e.local2 = e.far2 = e.p2 = 0;
  bool known = false;
  const VecX local = e.local.whole();
  e.bar = e.local.pointwise(line).cwiseMax(e.local.least);
  for (Eigen::Index i = 0; i < line.p.size(); ++i) {
    const FarError far = far_at(e, i);
    const double amplitude = e.fluctuation ? e.fluctuation->part() * e.fluctuation->amplitude(i) : 0,
                 fluctuation = e.fluctuation ? e.fluctuation->part() * e.fluctuation->p(i) : 0;
    e.bar(i) = error_safety * (e.bar(i) + (line.loaded[i] ? std::hypot(far.most, amplitude) : 0));
    if (!e.counts(i)) continue;
    // What shorter edges at a border make less counts with the line.
    e.local2 += local(i) * local(i) + (far.most * far.most - far.mean * far.mean) * line.h(i);
    e.far2 += (far.mean * far.mean + fluctuation * fluctuation) * line.h(i);
    const double p = line.whole(i);
    e.p2 += p * p * line.h(i);
    known = known || is_known(e, i);
  }
  for (const LineError::Border& border : e.local.borders) add_beyond(border, border_motion(e, border), e);
  if (!known) e.local2 = std::max(e.local2, e.p2);
}

}  // namespace mortise
