// Boxes in the plane, to be looked up by place: an R-tree.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "base/types.hpp"

namespace mortise {

using Box = Eigen::AlignedBox2d;

class BoxIndex {
 public:
  explicit BoxIndex(const std::vector<Box>& boxes);
  ~BoxIndex();
  BoxIndex(BoxIndex&&) noexcept;
  BoxIndex& operator=(BoxIndex&&) noexcept;

  /// Numbers of the boxes that have a point in common with `box`, ascending.
  std::vector<int> meeting(const Box& box) const;

  /// Calls it for the boxes that the straight line between two places meets.
  std::vector<int> meeting(const Vec2& from, const Vec2& to) const;

  /// Numbers of the `count` boxes nearest to x, nearest first; all where there are fewer.
  std::vector<int> nearest(const Vec2& x, int count) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace mortise
