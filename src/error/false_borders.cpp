#include "error/false_borders.hpp"

#include <algorithm>

#include "error/pressure_swing.hpp"

namespace mortise {
namespace {

// How far p_h swings from a tip on, in steps of 1 or -1: swing_reach vertices, and on as long as one of the next so
// many is without p_h between two that have it. The shorter the edges, the larger the swings; where they are larger
// than p, single vertices open, where contact ends, all that follow.
Eigen::Index swing_end(const PressureLine& line, Eigen::Index tip, int step) {
  const Eigen::Index last = line.p.size() - 1, to_end = step < 0 ? tip : last - tip;
  const auto p = [&](Eigen::Index away) { return line.p(tip + step * away); };
  Eigen::Index end = std::min<Eigen::Index>(swing_reach, to_end);
  for (Eigen::Index away = 1; away < to_end && away <= end + swing_reach; ++away)
    if (p(away) == 0 && p(away - 1) != 0 && p(away + 1) != 0) end = std::max(end, away);
  return tip + step * end;
}

// Where p has no limit p_h at the place's vertex may open the next one, with p on both sides of it: that and those
// beside it.
std::vector<char> opened_by_points(const PressureEstimate& e) {
  const Eigen::Index last = e.line.p.size() - 1;
  std::vector<char> all(last + 1, 0);
  for (const SingularPoint& point : e.singular) {
    const Eigen::Index at = e.line.nearest(point.position);
    for (const Eigen::Index step : {-1, 1}) {
      if (!(point.pressure_exponent < 1) || at + 2 * step < 0 || at + 2 * step > last) continue;
      if (e.line.p(at) == 0 || e.line.p(at + step) != 0 || e.line.p(at + 2 * step) == 0) continue;
      for (const Eigen::Index away : {0, 1, 2}) all[at + away * step] = 1;
    }
  }
  return all;
}

}  // namespace

std::vector<char> swinging(const PressureEstimate& e) {
  std::vector<char> all(e.line.p.size(), 0);
  for (const SingularPoint& point : e.singular) {
    if (!point.is_swinging()) continue;
    const Eigen::Index tip = e.line.nearest(point.position);
    for (Eigen::Index i = swing_end(e.line, tip, -1); i <= swing_end(e.line, tip, 1); ++i) all[i] = 1;
  }
  return all;
}

void forget_false_borders(PressureEstimate& e) {
  const std::vector<char> opened = opened_by_points(e);
  const auto is_false = [&](Eigen::Index i) { return e.swings[i] || opened[i]; };
  std::erase_if(e.local.borders, [&](const LineError::Border& b) { return is_false(b.edge) || is_false(b.edge + 1); });
  for (Eigen::Index i = 0; i < e.line.p.size(); ++i) e.local.border[i] = e.local.border[i] && !is_false(i);
}

}  // namespace mortise
