#include "mesh/thickness.hpp"

#include <algorithm>
#include <limits>

#include "base/vectors.hpp"

namespace mortise {
namespace {

constexpr double coincide = 0.1;  // of an edge: two meshes of one line that turns by less than 0.8 from edge to edge
constexpr double at_a_vertex = 1e-9;  // of a piece: it begins where the line does, to round-off

}  // namespace

std::vector<std::vector<Edge>> outlines(const BoundaryEdges& boundary, const std::vector<int>& bonded) {
  std::vector<std::vector<Edge>> edges(bonded.size());
  for (const BoundaryEdge& edge : boundary.edges)
    if (!edge.shared) edges[bonded[edge.body]].push_back(edge.edge);
  return edges;
}

BodyOutline::BodyOutline(const Points& nodes, const std::vector<Edge>& edges)
    : pieces_(straight(nodes, edges)), boxes_(boxes_of(pieces_)) {
  Box all;
  for (const Straight& piece : pieces_) all.extend(piece.from).extend(piece.to);
  diagonal_ = pieces_.empty() ? 0 : all.diagonal().norm();
}

std::vector<BodyOutline::Straight> BodyOutline::straight(const Points& nodes, const std::vector<Edge>& edges) {
  std::vector<Straight> pieces;
  const auto add = [&](int start, int end) { pieces.push_back({start, end, nodes.row(start), nodes.row(end)}); };
  for (const Edge& e : edges) {
    if (e.node_count == 2) {
      add(e.nodes[0], e.nodes[1]);
    } else {
      add(e.nodes[0], e.nodes[2]);
      add(e.nodes[2], e.nodes[1]);
    }
  }
  return pieces;
}

std::vector<Box> BodyOutline::boxes_of(const std::vector<Straight>& pieces) {
  std::vector<Box> boxes;
  for (const Straight& piece : pieces) {
    const Vec2 margin = Vec2::Constant(1e-6 * (piece.to - piece.from).norm());  // a line that just touches it meets it
    boxes.emplace_back(piece.from.cwiseMin(piece.to) - margin, piece.from.cwiseMax(piece.to) + margin);
  }
  return boxes;
}

double BodyOutline::way_out(const Edge& edge, const Vec2& from, const Vec2& along, double reach,
                            const Face& face) const {
  const auto on_face = [&](int node) { return std::ranges::binary_search(face.nodes, node); };
  double nearest = std::numeric_limits<double>::infinity();
  for (const int k : boxes_.meeting(from, from + reach * along)) {
    const Straight& piece = pieces_[k];
    const bool own = piece.start == edge.nodes[0] || piece.end == edge.nodes[1];
    const Vec2 a = piece.from - from, b = piece.to - from;
    const double left = cross(along, a), right = cross(along, b);
    if (own || left * right > 0 || left == right) continue;
    const double t = (left * b - right * a).dot(along) / (left - right);
    if (on_face(piece.start) && on_face(piece.end) && t < face.near) continue;
    if (t > at_a_vertex * (b - a).norm()) nearest = std::min(nearest, t);
  }
  return nearest;
}

Thickness::Thickness(const Points& nodes, const BoundaryEdges& boundary, const std::vector<int>& bonded)
    : nodes_(nodes), bonded_(bonded) {
  for (const std::vector<Edge>& edges : outlines(boundary, bonded))
    outlines_.push_back(std::make_shared<BodyOutline>(nodes, edges));
}

std::vector<double> Thickness::behind(const Curve& curve, const Curve* face) const {
  const auto point = [&](int node) { return Vec2(nodes_.row(node).transpose()); };
  const BodyOutline& outline = *outlines_[bonded_[curve.body]];
  BodyOutline::Face other{face ? curve_nodes(*face) : std::vector<int>(), 0};
  std::ranges::sort(other.nodes);
  std::vector<double> thickness;
  thickness.reserve(curve.edges.size());
  for (const Edge& e : curve.edges) {
    const Vec2 start = point(e.nodes[0]), end = point(e.nodes[1]);
    const Vec2 middle = e.node_count == 3 ? point(e.nodes[2]) : Vec2((start + end) / 2);
    const Vec2 along = (end - start).normalized(), inward(-along.y(), along.x());  // a 3-node edge's tangent too
    other.near = coincide * (end - start).norm();
    thickness.push_back(outline.way_out(e, middle, inward, outline.diagonal(), other));
  }
  return thickness;
}

}  // namespace mortise
