// Dual solutions that serve windows far from each other at once, so that their number does not grow with the pairs.
#pragma once

#include "mesh/mesh.hpp"

namespace mortise {

/// So many windows have a dual each; more share shared_count of them.
inline constexpr int most_own_duals = 32, shared_count = 12;

/// Where a window lies.
struct WindowPlace {
  Vec2 centre;
  double reach;  ///< half of the distance to the next one
};

struct SharedDuals {
  std::vector<int> dual;            ///< of each window
  int count = 0;                    ///< of the duals
  std::vector<WindowPlace> places;  ///< of the windows
  /// Of each body and dual (body * count + dual) the windows that what the dual says there counts for.
  std::vector<std::vector<int>> near;

  /// Whether each window has its own.
  bool own() const { return count == int(dual.size()); }

  /// Calls visit(window, part) for the windows that what dual d says at a place of a body counts for: part 1 for the
  /// nearest one, for others less by the fourth power of the distances. The stresses of a window's dual fall as the
  /// second, their second derivatives, with which quadratic elements err, as the fourth.
  template <typename Visit>
  void for_each_window(int body, int d, const Vec2& x, const Visit& visit) const {
    const std::vector<int>& windows = near[std::size_t(body) * count + d];
    const auto away = [&](int k) { return (places[k].centre - x).norm() + places[k].reach; };
    double nearest = away(windows[0]);
    for (const int k : windows) nearest = std::min(nearest, away(k));
    for (const int k : windows) {
      const double ratio = nearest / away(k), square = ratio * ratio;
      visit(k, square * square);
    }
  }
};

/// One dual a window where there are at most `most_own`; else shared_count of them, shared by windows as far from each
/// other as may be: one by one, each window takes the dual whose windows so far are farthest away. Time and memory as
/// the bodies and windows where no body has a large part of all windows around it.
SharedDuals share_duals(const Mesh& mesh, std::vector<WindowPlace> places, int most_own = most_own_duals);

}  // namespace mortise
