#include "mesh/thickness.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>

namespace mortise {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

struct KeyedSide {
  std::uint64_t key;  // one number for both directions of an edge
  CellSide side;
};

// Of each body, whether it hangs together with this one by common nodes.
std::vector<char> joined_with(const Mesh& mesh, int body) {
  std::vector<int> group(mesh.bodies.size()), first(std::size_t(mesh.nodes.rows()), -1);
  std::iota(group.begin(), group.end(), 0);
  for (const Cell& cell : mesh.cells)
    for (int a = 0; a < corner_count(cell.kind); ++a) {
      int& other = first[cell.nodes[a]];
      if (other < 0) other = cell.body;
      const int from = group[other], to = group[cell.body];
      if (from != to) std::replace(group.begin(), group.end(), from, to);
    }
  std::vector<char> joined;
  for (const int g : group) joined.push_back(g == group[body]);
  return joined;
}

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

std::vector<Edge> outline(const Mesh& mesh, int body) {
  const std::vector<char> joined = joined_with(mesh, body);
  std::vector<KeyedSide> sides;
  for (int c = 0; c < int(mesh.cells.size()); ++c) {
    const Cell& cell = mesh.cells[c];
    if (!joined[cell.body]) continue;
    const int corners = corner_count(cell.kind);
    for (int s = 0; s < corners; ++s) {
      const auto [low, high] = std::minmax(cell.nodes[s], cell.nodes[(s + 1) % corners]);
      sides.push_back({std::uint64_t(low) << 32 | std::uint64_t(high), {c, s}});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const KeyedSide& a, const KeyedSide& b) { return a.key < b.key; });
  std::vector<Edge> edges;
  for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
    for (next = i + 1; next < sides.size() && sides[next].key == sides[i].key;) ++next;
    if (next == i + 1) edges.push_back(side_edge(mesh.cells[sides[i].side.cell], sides[i].side.side));
  }
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
