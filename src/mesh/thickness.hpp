// How thick a body is behind its contact curve.
#pragma once

#include "mesh/boundary_edges.hpp"
#include "mesh/box_index.hpp"
#include "mesh/curve.hpp"

namespace mortise {

/// The edges around each body. Bodies that share nodes (`bonded`: bonded_to) are one, that of the first of them: a
/// layer on its ground is as thick as both.
std::vector<std::vector<Edge>> outlines(const BoundaryEdges& boundary, const std::vector<int>& bonded);

class Thickness {
 public:
  Thickness(const Points& nodes, const BoundaryEdges& boundary, const std::vector<int>& bonded);

  /// For each edge of the curve, the length of the line from its middle along its inward normal to where that first
  /// leaves the body. The outline's 3-node edges count as two straight ones. `face`: of the same or a bonded body, the
  /// other face of a crack, which does not count where it lies there too, to a tenth of an edge.
  std::vector<double> behind(const Curve& curve, const Curve* face = nullptr) const;

 private:
  struct Straight {
    int start, end;  // nodes
  };
  struct Pieces {
    std::vector<Straight> pieces;
    BoxIndex boxes;  // of the pieces
    double diagonal;
  };
  static Pieces pieces_of(const Points& nodes, const std::vector<Edge>& outline);

  Points nodes_;
  std::vector<int> bonded_;
  std::vector<Pieces> outlines_;
};

}  // namespace mortise
