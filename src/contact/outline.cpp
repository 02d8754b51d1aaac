#include "contact/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vectors.hpp"
#include "contact/projection.hpp"
#include "contact/segments.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// The edges of a piece by the node that they start from.
void link(Outline& o, const PieceOutline& piece) {
  std::vector<std::pair<int, int>> starts;
  for (int e = piece.first; e < piece.last; ++e) starts.emplace_back(o.edges[e].edge.nodes[0], e);
  std::sort(starts.begin(), starts.end());
  for (int e = piece.first; e < piece.last; ++e) {
    const int end = o.edges[e].edge.nodes[1];
    const auto next = std::lower_bound(starts.begin(), starts.end(), std::pair(end, -1));
    if (next == starts.end() || next->first != end) continue;
    o.neighbour[e][1] = next->second;
    o.neighbour[next->second][0] = e;
  }
}

void measure_vertices(Outline& o, int e) {
  const EdgePoint own[2] = {edge_point(o.nodes, o.edges[e].edge, -1), edge_point(o.nodes, o.edges[e].edge, 1)};
  double smooth = 0;
  for (int end = 0; end < 2; ++end) {
    o.vertex_normal[e][end] = own[end].normal();
    const int other = o.neighbour[e][end];
    if (other < 0) continue;
    const EdgePoint there = edge_point(o.nodes, o.edges[other].edge, end == 0 ? 1 : -1);
    const Vec2 sum = own[end].normal() + there.normal();
    if (sum.norm() > 1e-6) o.vertex_normal[e][end] = sum.normalized();
    o.turn[e][end] = angle_between(own[end].tangent, there.tangent);
    if (o.turn[e][end] < smooth_turn) smooth = std::max(smooth, o.turn[e][end]);
  }
  // A chord of an arc turns by h / R at both ends and lies h^2 / 8R from it; of a quadratic edge the turn is of third
  // order and the distance a quarter of this.
  o.sagitta[e] = o.length[e] * smooth / 8;
}

// Area by Green's theorem, of the polygon through ends and middles.
double area_of(const Outline& o, int e) {
  const Edge& edge = o.edges[e].edge;
  const auto cross = [&](int a, int b) { return (o.nodes(a, 0) * o.nodes(b, 1) - o.nodes(a, 1) * o.nodes(b, 0)) / 2; };
  if (edge.node_count == 2) return cross(edge.nodes[0], edge.nodes[1]);
  return cross(edge.nodes[0], edge.nodes[2]) + cross(edge.nodes[2], edge.nodes[1]);
}

PieceOutline piece_outline(const Outline& o, int first, int last) {
  std::vector<Box> boxes;
  Box all;
  double area = 0, perimeter = 0;
  for (int e = first; e < last; ++e) {
    boxes.push_back(edge_box(o, e, 0));
    all.extend(boxes.back());
    area += area_of(o, e);
    perimeter += o.length[e];
  }
  return {o.edges[first].body, first, last, all, area, perimeter, BoxIndex(boxes)};
}

// The nearest place of one edge.
OutlinePlace nearest_on_edge(const Outline& o, int e, const Vec2& x) {
  const Edge& edge = o.edges[e].edge;
  OutlinePlace best{e, 0, std::numeric_limits<double>::infinity(), Vec2::Zero(), true};
  if (const auto foot = foot_on_edge(o.nodes, edge, x)) {
    const EdgePoint p = edge_point(o.nodes, edge, *foot);
    best = {e, *foot, (x - p.position).dot(p.normal()), p.normal(), false};
  }
  for (int end = 0; end < 2; ++end) {
    const Vec2 away = x - o.nodes.row(edge.nodes[end]).transpose();
    if (away.norm() >= std::abs(best.distance)) continue;
    const Vec2& normal = o.vertex_normal[e][end];
    best = {e, end == 0 ? -1. : 1., std::copysign(away.norm(), away.dot(normal)), normal, true};
  }
  return best;
}

}  // namespace

Outline outline(const BoundaryEdges& boundary, const Points& nodes) {
  const std::size_t count = boundary.edges.size();
  Outline o{nodes, boundary.edges, std::vector<std::array<int, 2>>(count, {-1, -1}), {}, {}, {}, {}, {}, BoxIndex({})};
  o.vertex_normal.resize(count);
  o.turn.resize(count, {0, 0});
  o.sagitta.resize(count, 0);
  for (const BoundaryEdge& edge : o.edges) o.length.push_back(edge_length(nodes, edge.edge));
  std::vector<Box> boxes;
  for (int first = 0, last = 0; first < int(count); first = last) {
    while (last < int(count) && o.edges[last].piece == o.edges[first].piece) ++last;
    o.pieces.push_back(piece_outline(o, first, last));
    link(o, o.pieces.back());
    boxes.push_back(o.pieces.back().box);
  }
  for (int e = 0; e < int(count); ++e) measure_vertices(o, e);
  o.boxes = BoxIndex(boxes);
  return o;
}

OutlinePlace nearest(const Outline& o, int piece, const Vec2& x) {
  const PieceOutline& p = o.pieces[piece];
  OutlinePlace best{-1, 0, std::numeric_limits<double>::infinity(), Vec2::Zero(), true};
  const auto look_at = [&](int number) {
    const OutlinePlace place = nearest_on_edge(o, p.first + number, x);
    if (std::abs(place.distance) < std::abs(best.distance)) best = place;
  };
  // No edge is nearer than one of the nearest box unless its box comes as near.
  for (const int number : p.edges.nearest(x, 1)) look_at(number);
  const Vec2 around = Vec2::Constant(std::abs(best.distance));
  for (const int number : p.edges.meeting(Box(x - around, x + around))) look_at(number);
  return best;
}

Box edge_box(const Outline& o, int e, double margin) {
  const Edge& edge = o.edges[e].edge;
  const Vec2 start = o.nodes.row(edge.nodes[0]), end = o.nodes.row(edge.nodes[1]);
  Box box(start);
  box.extend(end);
  // A parabola lies between its ends and the third point of its Bernstein polygon.
  if (edge.node_count == 3) box.extend(Vec2(2 * o.nodes.row(edge.nodes[2]).transpose() - (start + end) / 2));
  return {box.min().array() - margin, box.max().array() + margin};
}

}  // namespace mortise
