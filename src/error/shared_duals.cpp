#include "error/shared_duals.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "mesh/box_index.hpp"

namespace mortise {
namespace {

constexpr int looked_at = 4;  // nearest windows that each one asks, times the number of duals

BoxIndex index_of(const std::vector<Vec2>& places) {
  std::vector<Box> boxes;
  for (const Vec2& x : places) boxes.emplace_back(x);
  return BoxIndex(boxes);
}

// Of each dual the distance of its nearest window, among those looked at; the others are farther away.
std::vector<double> distances(const BoxIndex& index, const std::vector<int>& dual, const Vec2& x, int most) {
  std::vector<double> nearest(most, std::numeric_limits<double>::infinity());
  int left = looked_at * most;
  index.nearest_first(x, [&](int window, double distance) {
    if (const int d = dual[window]; d >= 0) nearest[d] = std::min(nearest[d], distance);
    return --left > 0;
  });
  return nearest;
}

std::vector<int> dealt_out(const std::vector<Vec2>& centres, int most) {
  const BoxIndex index = index_of(centres);
  std::vector<int> dual(centres.size(), -1), windows(most, 0);
  for (std::size_t k = 0; k < centres.size(); ++k) {
    const std::vector<double> away = distances(index, dual, centres[k], most);
    int best = 0;  // of those equally far away the one with the fewest windows
    for (int d = 1; d < most; ++d)
      if (away[d] > away[best] || (away[d] == away[best] && windows[d] < windows[best])) best = d;
    dual[k] = best;
    ++windows[best];
  }
  return dual;
}

}  // namespace

SharedDuals share_duals(const Mesh& mesh, const std::vector<Vec2>& centres, int most) {
  const int windows = int(centres.size());
  SharedDuals shared;
  shared.count = std::min(windows, most);
  shared.window.resize(Eigen::Index(mesh.cells.size()), shared.count);
  if (windows <= most) {
    shared.dual.resize(windows);
    std::iota(shared.dual.begin(), shared.dual.end(), 0);
    for (int d = 0; d < windows; ++d) shared.window.col(d).setConstant(d);
    return shared;
  }
  shared.dual = dealt_out(centres, most);
  for (int d = 0; d < most; ++d) {
    std::vector<int> members;
    std::vector<Vec2> places;
    for (int k = 0; k < windows; ++k) {
      if (shared.dual[k] != d) continue;
      members.push_back(k);
      places.push_back(centres[k]);
    }
    const BoxIndex index = index_of(places);
    for (Eigen::Index e = 0; e < shared.window.rows(); ++e)
      index.nearest_first(centre_of(mesh.nodes, mesh.cells[e]), [&](int member, double) {
        shared.window(e, d) = members[member];
        return false;
      });
  }
  return shared;
}

}  // namespace mortise
