#include "error/pressure_bars.hpp"

#include <algorithm>
#include <cmath>

#include "error/goal_estimate.hpp"

namespace mortise {
namespace {

// At a vertex: linear between the windows' centres, constant beyond them, around a closed line from the last one to the
// first; of what corners nearby do each by its shape.
double between_windows(const PressureEstimate& e, Eigen::Index i) {
  if (e.windows.empty()) return 0;
  const double s = e.line.s(i);
  const int count = int(e.windows.size());
  int k = 0;
  while (k < count && e.windows[k].s < s) ++k;
  const int before = k > 0 || e.line.closed ? (k + count - 1) % count : 0,
            after = k < count || e.line.closed ? k % count : count - 1;
  const double from = e.line.distance(e.windows[before].s, s), to = e.line.distance(s, e.windows[after].s);
  const double part = from + to > 0 ? from / (from + to) : 0;
  double far = (1 - part) * e.far(before) + part * e.far(after);
  for (const LocalTail& tail : e.tails.local) {
    if (tail.window == before) far += (1 - part) * tail.at(e.line.position[i]);
    if (tail.window == after && after != before) far += part * tail.at(e.line.position[i]);
  }
  return far;
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
    const double open = line.s(line.p(border.edge) == 0 ? border.edge : border.edge + 1);
    const auto from_border = [&](const PressureWindow& window) { return line.distance(window.s, open); };
    const PressureWindow& nearest = *std::ranges::min_element(e.windows, {}, from_border);
    const double centre = nearest.from_border > 0 ? nearest.from_border : from_border(nearest);
    if (line.distance(line.s(i), nearest.s) > centre) continue;
    const double quarter = far * std::sqrt(centre) / (2 * border.root),
                 r = std::max(line.distance(line.s(i), open), quarter);
    found.most = std::max(found.most, far * std::sqrt(centre / r));
    found.mean = std::max(found.mean, far * std::sqrt(centre / std::max(r, line.h(i) / 2)));
  }
  return found;
}

// Whether p is known better than to its own size.
bool is_known(const PressureEstimate& e, Eigen::Index i) {
  return std::abs(e.line.whole(i)) > (e.local.least.size() > 0 ? e.local.least(i) : 0);
}

}  // namespace

void find_excluded(double part, PressureEstimate& e) {
  const PressureLine& line = e.line;
  double length = 0;
  for (Eigen::Index i = 0; i + 1 < line.p.size(); ++i)
    if (line.loaded[i] && line.loaded[i + 1]) length += line.s(i + 1) - line.s(i);
  e.excluded_distance = part * length;
  e.excluded.assign(line.p.size(), 0);
  for (Eigen::Index i = 0; i < line.p.size(); ++i)
    for (const SingularPoint& point : e.singular)
      if (point.is_unbounded() && (line.position[i] - point.position).norm() < e.excluded_distance) e.excluded[i] = 1;
  // A mesh too coarse to tell what is near such a point from the rest of the contact: all of it counts.
  bool left = false;
  for (Eigen::Index i = 0; i < line.p.size(); ++i)
    left = left || (line.loaded[i] && line.p(i) != 0 && !e.excluded[i] && is_known(e, i));
  if (!left) e.excluded.assign(line.p.size(), 0);
  // Where contact ends in what is left out, p is a root of nothing beyond.
  for (Eigen::Index i = 0; i < line.p.size(); ++i) e.local.border[i] = e.local.border[i] && !e.excluded[i];
}

void find_bars(PressureEstimate& e) {
  const PressureLine& line = e.line;
  e.local2 = e.far2 = e.p2 = 0;
  bool known = false;
  const VecX local = e.local.whole();
  e.bar = e.local.pointwise(line);
  if (e.local.least.size() > 0) e.bar = e.bar.cwiseMax(e.local.least);
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
  if (!known) e.local2 = std::max(e.local2, e.p2);
}

}  // namespace mortise
