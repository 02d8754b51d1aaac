// The arc length s along a boundary.
#pragma once

#include <unordered_map>
#include <vector>

#include "fem/edges.hpp"

namespace mortise {

/// s of the undeformed mesh, from the end of the curve with the smaller x, then y; of a closed one from its leftmost
/// node with the body on the left (docs/notation.md).
class ArcLength {
 public:
  ArcLength(const Points& nodes, const Curve& curve);

  /// At an edge of the curve and its reference coordinate.
  double at(int edge, double xi) const;
  /// At a place that lies on this edge.
  double at(int edge, const Vec2& place) const;
  /// At a node of the curve.
  double at_node(int node) const { return at_node_.at(node); }

 private:
  Points nodes_;                // of the curve
  std::vector<Edge> edges_;     // by these
  std::vector<double> before_;  // length of the curve before each edge, and all of it
  bool backwards_;
  std::unordered_map<int, double> at_node_;
};

}  // namespace mortise
