#include "mesh/thickness.hpp"

#include <algorithm>
#include <limits>

#include "base/vectors.hpp"

namespace mortise {
namespace {

constexpr double coincide = 0.1;  // of an edge: two meshes of one line that turns by less than 0.8 from edge to edge

}  // namespace

std::vector<std::vector<Edge>> outlines(const BoundaryEdges& boundary, const std::vector<int>& bonded) {
  std::vector<std::vector<Edge>> edges(bonded.size());
  for (const BoundaryEdge& edge : boundary.edges)
    if (!edge.shared) edges[bonded[edge.body]].push_back(edge.edge);
  return edges;
}

Thickness::Thickness(const Points& nodes, const BoundaryEdges& boundary, const std::vector<int>& bonded)
    : nodes_(nodes), bonded_(bonded) {
  for (const std::vector<Edge>& outline : outlines(boundary, bonded)) outlines_.push_back(pieces_of(nodes, outline));
}

Thickness::Pieces Thickness::pieces_of(const Points& nodes, const std::vector<Edge>& outline) {
  std::vector<Straight> pieces;
  for (const Edge& e : outline) {
    if (e.node_count == 2) {
      pieces.push_back({e.nodes[0], e.nodes[1]});
    } else {
      pieces.push_back({e.nodes[0], e.nodes[2]});
      pieces.push_back({e.nodes[2], e.nodes[1]});
    }
  }
  std::vector<Box> boxes;
  Box all;
  for (const Straight& piece : pieces) {
    const Vec2 a = nodes.row(piece.start), b = nodes.row(piece.end);
    const Vec2 margin = Vec2::Constant(1e-6 * (b - a).norm());  // a line that just touches it meets it
    boxes.emplace_back(a.cwiseMin(b) - margin, a.cwiseMax(b) + margin);
    all.extend(boxes.back());
  }
  return {std::move(pieces), BoxIndex(boxes), boxes.empty() ? 0 : all.diagonal().norm()};
}

std::vector<double> Thickness::behind(const Curve& curve, const Curve* face) const {
  const auto point = [&](int node) { return Vec2(nodes_.row(node).transpose()); };
  const Pieces& outline = outlines_[bonded_[curve.body]];
  std::vector<int> of_face = face ? curve_nodes(*face) : std::vector<int>();
  std::ranges::sort(of_face);
  const auto on_face = [&](int node) { return std::ranges::binary_search(of_face, node); };
  std::vector<double> thickness;
  thickness.reserve(curve.edges.size());
  for (const Edge& e : curve.edges) {
    const Vec2 start = point(e.nodes[0]), end = point(e.nodes[1]);
    const Vec2 middle = e.node_count == 3 ? point(e.nodes[2]) : Vec2((start + end) / 2);
    const Vec2 along = (end - start).normalized(), inward(-along.y(), along.x());  // a 3-node edge's tangent too
    double nearest = std::numeric_limits<double>::infinity();
    for (const int k : outline.boxes.meeting(middle, middle + outline.diagonal * inward)) {
      const Straight& piece = outline.pieces[k];
      const bool own = piece.start == e.nodes[0] || piece.end == e.nodes[1];
      const Vec2 a = point(piece.start) - middle, b = point(piece.end) - middle;
      const double left = cross(inward, a), right = cross(inward, b);
      if (own || left * right > 0 || left == right) continue;
      const double t = (left * b - right * a).dot(inward) / (left - right);
      if (on_face(piece.start) && on_face(piece.end) && t < coincide * (end - start).norm()) continue;
      if (t > 0) nearest = std::min(nearest, t);
    }
    thickness.push_back(nearest);
  }
  return thickness;
}

}  // namespace mortise
