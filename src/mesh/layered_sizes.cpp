#include "mesh/layered_sizes.hpp"

#include <algorithm>
#include <limits>

namespace mortise {
LayeredSizes::LayeredSizes(std::vector<SizeLayers> layers) : layers_(std::move(layers)) {
  if (!layers_.empty()) grow(0, int(layers_.size()));
}

// Halves at the middle of the longer side.
void LayeredSizes::grow(int first, int last) {
  constexpr int leaf = 8;  // layers; a few are looked at sooner than their boxes
  const auto from = layers_.begin() + first, to = layers_.begin() + last;
  Branch branch{Box(), from->least, from->growth, first, last};
  for (auto layer = from; layer != to; ++layer) {
    branch.centres.extend(layer->centre);
    branch.least = std::min(branch.least, layer->least);
    branch.growth = std::min(branch.growth, layer->growth);
  }
  const std::size_t number = branches_.size();
  branches_.push_back(branch);
  if (last - first <= leaf) return;
  const int middle = (first + last) / 2, axis = branch.centres.sizes().x() < branch.centres.sizes().y();
  std::nth_element(from, layers_.begin() + middle, to,
                   [axis](const SizeLayers& a, const SizeLayers& b) { return a.centre(axis) < b.centre(axis); });
  grow(first, middle);
  branches_[number].second = int(branches_.size());
  grow(middle, last);
}

void LayeredSizes::search(int number, const Vec2& x, double& size) const {
  constexpr double round_off = 1 - 1e-12;  // of a bound, which must not be above what it bounds
  const Branch& branch = branches_[number];
  if (branch.second == 0) {
    for (int i = branch.first; i < branch.last; ++i)
      size = std::min(size, layers_[i].least + layers_[i].growth * (x - layers_[i].centre).norm());
    return;
  }
  int near = number + 1, far = branch.second;
  double at_near = branches_[near].bound(x), at_far = branches_[far].bound(x);
  if (at_far < at_near) {
    std::swap(near, far);
    std::swap(at_near, at_far);
  }
  if (round_off * at_near < size) search(near, x, size);
  if (round_off * at_far < size) search(far, x, size);
}

double LayeredSizes::operator()(const Vec2& x) const {
  double size = std::numeric_limits<double>::infinity();
  if (!branches_.empty()) search(0, x, size);
  return size;
}

}  // namespace mortise
