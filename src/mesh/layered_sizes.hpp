// Sizes that grow away from places where elements must be small.
#pragma once

#include <vector>

#include "mesh/box_index.hpp"

namespace mortise {

/// Towards a point elements shrink to `least`: least + growth * distance.
struct SizeLayers {
  Vec2 centre;
  double least, growth;
};

/// The least of many layers, infinite of none. A tree of boxes, by branch and bound: what no layer of a branch can be
/// below at a place, its least size and growth at its box's distance, leaves out all branches but a few.
class LayeredSizes {
 public:
  explicit LayeredSizes(std::vector<SizeLayers> layers);

  double operator()(const Vec2& x) const;

 private:
  /// Layers first ... last - 1; the first half of them is the next branch, the second half number `second`, 0 in
  /// leaves.
  struct Branch {
    Box centres;
    double least, growth;
    int first, last, second = 0;

    double bound(const Vec2& x) const { return least + growth * centres.exteriorDistance(x); }
  };
  void grow(int first, int last);
  void search(int branch, const Vec2& x, double& size) const;

  std::vector<SizeLayers> layers_;
  std::vector<Branch> branches_;  // the first holds all
};

}  // namespace mortise
