#include "mesh/thickness.hpp"

#include <algorithm>
#include <limits>

#include "base/vectors.hpp"

namespace mortise {
namespace {

struct Straight {
  int start, end;
};

// The edges as straight pieces between neighbouring nodes.
std::vector<Straight> pieces_of(const std::vector<Edge>& edges) {
  std::vector<Straight> pieces;
  for (const Edge& e : edges) {
    if (e.node_count == 2) {
      pieces.push_back({e.nodes[0], e.nodes[1]});
    } else {
      pieces.push_back({e.nodes[0], e.nodes[2]});
      pieces.push_back({e.nodes[2], e.nodes[1]});
    }
  }
  return pieces;
}

}  // namespace

std::vector<Edge> outline(const BoundaryEdges& boundary, const std::vector<int>& bonded, int body) {
  std::vector<Edge> edges;
  for (const BoundaryEdge& edge : boundary.edges)
    if (!edge.shared && bonded[edge.body] == bonded[body]) edges.push_back(edge.edge);
  return edges;
}

std::vector<double> thickness_behind(const Points& nodes, const Curve& curve, const std::vector<Edge>& outline) {
  const auto point = [&](int node) { return Vec2(nodes.row(node).transpose()); };
  const std::vector<Straight> pieces = pieces_of(outline);
  std::vector<double> thickness;
  thickness.reserve(curve.edges.size());
  for (const Edge& e : curve.edges) {
    const Vec2 start = point(e.nodes[0]), end = point(e.nodes[1]);
    const Vec2 middle = e.node_count == 3 ? point(e.nodes[2]) : Vec2((start + end) / 2);
    const Vec2 along = (end - start).normalized(), inward(-along.y(), along.x());  // a 3-node edge's tangent too
    double nearest = std::numeric_limits<double>::infinity();
    for (const Straight& piece : pieces) {
      const bool own = piece.start == e.nodes[0] || piece.end == e.nodes[1];
      const Vec2 a = point(piece.start) - middle, b = point(piece.end) - middle;
      const double left = cross(inward, a), right = cross(inward, b);
      if (own || left * right > 0 || left == right) continue;
      const double t = (left * b - right * a).dot(inward) / (left - right);
      if (t > 0) nearest = std::min(nearest, t);
    }
    thickness.push_back(nearest);
  }
  return thickness;
}

}  // namespace mortise
