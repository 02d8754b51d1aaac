#include "mesh_files/mesh_data.hpp"

#include <algorithm>

namespace mortise {

void move(const Vec2& by, MeshData& data) {
  if (by == Vec2::Zero()) return;
  for (std::array<double, 3>& x : data.nodes) {
    x[0] += by.x();
    x[1] += by.y();
  }
  for (ElementBlock& block : data.blocks)
    for (EdgeSamples& edge : block.samples)
      for (SamplePiece& piece : edge.pieces)
        for (Vec2& place : piece.places) place += by;
}

TagRows::TagRows(const std::vector<std::int64_t>& tags) {
  const std::int64_t largest = tags.empty() ? 0 : *std::max_element(tags.begin(), tags.end());
  if (largest <= 4 * static_cast<std::int64_t>(tags.size()) + 1000) {
    dense_.assign(largest + 1, -1);
    for (std::size_t i = 0; i < tags.size(); ++i) dense_[tags[i]] = static_cast<int>(i);
    return;
  }
  by_tag_.reserve(tags.size());
  for (std::size_t i = 0; i < tags.size(); ++i) by_tag_.emplace_back(tags[i], static_cast<int>(i));
  std::sort(by_tag_.begin(), by_tag_.end());
}

int TagRows::find(std::int64_t tag) const {
  if (tag <= 0) return -1;
  if (!dense_.empty()) return tag < static_cast<std::int64_t>(dense_.size()) ? dense_[tag] : -1;
  const auto found = std::lower_bound(by_tag_.begin(), by_tag_.end(), std::pair(tag, 0));
  return found != by_tag_.end() && found->first == tag ? found->second : -1;
}

}  // namespace mortise
