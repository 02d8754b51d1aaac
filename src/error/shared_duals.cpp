#include "error/shared_duals.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "mesh/box_index.hpp"

namespace mortise {
namespace {

// Nearest windows that a window looks at, and that a dual counts for in a body; of each dual on average.
constexpr int looked_at = 4, around = 18;
constexpr double infinity = std::numeric_limits<double>::infinity();

BoxIndex index_of(const std::vector<WindowPlace>& places) {
  std::vector<Box> boxes;
  for (const WindowPlace& place : places) boxes.emplace_back(place.centre);
  return BoxIndex(boxes);
}

// One by one, each window takes the dual whose windows, among those nearest to it, are farthest away.
void deal_out(const BoxIndex& index, SharedDuals& shared) {
  shared.dual.assign(shared.places.size(), -1);
  std::vector<int> windows(shared.count, 0);
  std::vector<double> away(shared.count);
  for (std::size_t k = 0; k < shared.places.size(); ++k) {
    const Vec2& x = shared.places[k].centre;
    std::ranges::fill(away, infinity);
    for (const int near : index.nearest(x, looked_at * shared.count))
      if (const int d = shared.dual[near]; d >= 0) away[d] = std::min(away[d], (shared.places[near].centre - x).norm());
    int best = 0;  // of those equally far away the one with the fewest windows
    for (int d = 1; d < shared.count; ++d)
      if (away[d] > away[best] || (away[d] == away[best] && windows[d] < windows[best])) best = d;
    shared.dual[k] = best;
    ++windows[best];
  }
}

std::vector<Box> boxes_of_bodies(const Mesh& mesh) {
  std::vector<Box> boxes(mesh.bodies.size());
  for (const Cell& cell : mesh.cells) boxes[cell.body].extend(centre_of(mesh.nodes, cell));
  return boxes;
}

// Of each dual the windows around the box, and all that may be its nearest one to a place in it: no farther from the
// middle than the one nearest to that, and the box's diagonal.
std::vector<std::vector<int>> windows_near(const Box& box, const BoxIndex& index, const SharedDuals& shared) {
  const Vec2 middle = box.center();
  for (int count = around * shared.count;; count *= 2) {
    std::vector<std::vector<int>> found(shared.count);
    std::vector<double> enough(shared.count, infinity);
    double last = 0;
    for (const int k : index.nearest(middle, count)) {
      const int d = shared.dual[k];
      last = (shared.places[k].centre - middle).norm();
      if (found[d].empty()) enough[d] = last + shared.places[k].reach + box.diagonal().norm();
      found[d].push_back(k);
    }
    if (count >= int(shared.places.size()) || last > *std::ranges::max_element(enough)) return found;
  }
}

}  // namespace

SharedDuals share_duals(const Mesh& mesh, std::vector<WindowPlace> places, int most_own) {
  const int windows = int(places.size());
  SharedDuals shared{.dual = {}, .count = windows, .places = std::move(places), .near = {}};
  if (windows <= most_own) {
    shared.dual.resize(windows);
    std::iota(shared.dual.begin(), shared.dual.end(), 0);
    for (std::size_t b = 0; b < mesh.bodies.size(); ++b)
      for (int d = 0; d < windows; ++d) shared.near.push_back({d});
    return shared;
  }
  shared.count = std::min(windows, shared_count);
  const BoxIndex index = index_of(shared.places);
  deal_out(index, shared);
  for (const Box& box : boxes_of_bodies(mesh))
    for (std::vector<int>& near : windows_near(box, index, shared)) shared.near.push_back(std::move(near));
  return shared;
}

}  // namespace mortise
