// How thick a body is behind its contact curve.
#pragma once

#include "mesh/boundary_edges.hpp"
#include "mesh/box_index.hpp"
#include "mesh/curve.hpp"

namespace mortise {

/// The edges around each body. Bodies that share nodes (`bonded`: bonded_to) are one, that of the first of them: a
/// layer on its ground is as thick as both.
std::vector<std::vector<Edge>> outlines(const BoundaryEdges& boundary, const std::vector<int>& bonded);

/// The outline of a body; 3-node edges count as two straight ones.
class BodyOutline {
 public:
  BodyOutline(const Points& nodes, const std::vector<Edge>& edges);

  /// Edges that do not count where they are no further away than `near`.
  struct Face {
    std::vector<int> nodes;  // sorted
    double near;
  };

  /// How far a line from a place on an edge, along a unit direction into the body, goes before it leaves the body other
  /// than by that edge, length; infinite where it does not within `reach`, length.
  double way_out(const Edge& edge, const Vec2& from, const Vec2& along, double reach, const Face& face = {}) const;

  double diagonal() const { return diagonal_; }

 private:
  struct Straight {
    int start, end;  // nodes
    Vec2 from, to;   // their places
  };
  static std::vector<Straight> straight(const Points& nodes, const std::vector<Edge>& edges);
  static std::vector<Box> boxes_of(const std::vector<Straight>& pieces);

  std::vector<Straight> pieces_;
  BoxIndex boxes_;  // of the pieces
  double diagonal_;
};

class Thickness {
 public:
  Thickness(const Points& nodes, const BoundaryEdges& boundary, const std::vector<int>& bonded);

  /// For each edge of the curve, the length of the line from its middle along its inward normal to where that first
  /// leaves the body. `face`: of the same or a bonded body, the other face of a crack, which does not count where it
  /// lies there too.
  std::vector<double> behind(const Curve& curve, const Curve* face = nullptr) const;

  std::shared_ptr<const BodyOutline> outline(int body) const { return outlines_[bonded_[body]]; }

 private:
  Points nodes_;
  std::vector<int> bonded_;
  std::vector<std::shared_ptr<const BodyOutline>> outlines_;
};

}  // namespace mortise
