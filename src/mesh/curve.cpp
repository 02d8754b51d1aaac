#include "mesh/curve.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "base/union_find.hpp"

namespace mortise {
namespace {

Vec2 point(const Mesh& mesh, int node) { return mesh.nodes.row(node).transpose(); }

/// Of the control polygon, from the start to where the tangents of both ends meet to the end.
double polygon_length(const Mesh& mesh, const Edge& edge) {
  const Vec2 start = point(mesh, edge.nodes[0]), end = point(mesh, edge.nodes[1]);
  if (edge.node_count == 2) return (end - start).norm();
  const Vec2 corner = 2 * point(mesh, edge.nodes[2]) - (start + end) / 2;
  return (corner - start).norm() + (end - corner).norm();
}

/// Edges by the node they start from or end at. Seen from its body every edge runs the same way round, so on a chain
/// a node starts one edge at most and ends one at most.
using EdgeAt = std::unordered_map<int, std::size_t>;

[[noreturn]] void fail(const Mesh& mesh, int boundary, const std::string& trouble) {
  throw InputError(mesh.source + ": boundary '" + mesh.boundaries[boundary].name + "' " + trouble);
}

void check_one_body(const Mesh& mesh, int boundary, const std::vector<CellSide>& sides) {
  const int first = mesh.cells[sides.front().cell].body;
  for (const CellSide& side : sides) {
    const Cell& cell = mesh.cells[side.cell];
    if (cell.body == first) continue;
    fail(mesh, boundary,
         "belongs to more than one body: '" + mesh.bodies[first] + "', and '" + mesh.bodies[cell.body] + "' " +
             near_point(point(mesh, cell.nodes[side.side])) + "; expected a contact curve of one body");
  }
}

EdgeAt edges_by_node(const Mesh& mesh, int boundary, const std::vector<Edge>& edges, int end) {
  EdgeAt table;
  table.reserve(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const int node = edges[i].nodes[end];
    if (!table.emplace(node, i).second) {
      fail(mesh, boundary,
           "branches " + near_point(point(mesh, node)) + ": more than two of its edges meet; expected one chain");
    }
  }
  return table;
}

/// Of a closed chain: the edge that starts at the leftmost (then lowest) node, whatever the order of the file.
std::size_t leftmost_edge(const Mesh& mesh, const std::vector<Edge>& edges) {
  const auto before = [&mesh](const Edge& a, const Edge& b) {
    const Vec2 p = point(mesh, a.nodes[0]);
    const Vec2 q = point(mesh, b.nodes[0]);
    return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
  };
  return static_cast<std::size_t>(std::min_element(edges.begin(), edges.end(), before) - edges.begin());
}

[[noreturn]] void fail_pieces(const Mesh& mesh, int boundary, int node_of_one, int node_of_other) {
  fail(mesh, boundary,
       "falls into pieces: one starts " + near_point(point(mesh, node_of_one)) + ", another " +
           near_point(point(mesh, node_of_other)) + "; expected one chain");
}

/// The edge that no edge leads to; on a closed chain the leftmost.
std::size_t first_edge(const Mesh& mesh, int boundary, const std::vector<Edge>& edges, const EdgeAt& ending) {
  std::size_t first = edges.size();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (ending.contains(edges[i].nodes[0])) continue;
    if (first < edges.size()) fail_pieces(mesh, boundary, edges[first].nodes[0], edges[i].nodes[0]);
    first = i;
  }
  return first < edges.size() ? first : leftmost_edge(mesh, edges);
}

/// Indices of the edges, each followed by the one that starts where it ends.
std::vector<std::size_t> chain_order(const Mesh& mesh, int boundary, const std::vector<Edge>& edges) {
  const EdgeAt starting = edges_by_node(mesh, boundary, edges, 0);
  const EdgeAt ending = edges_by_node(mesh, boundary, edges, 1);

  std::vector<std::size_t> order{first_edge(mesh, boundary, edges, ending)};
  std::vector<char> visited(edges.size(), 0);
  visited[order[0]] = 1;
  for (auto next = starting.find(edges[order[0]].nodes[1]); next != starting.end() && !visited[next->second];
       next = starting.find(edges[order.back()].nodes[1])) {
    visited[next->second] = 1;
    order.push_back(next->second);
  }

  const auto left_out = std::find(visited.begin(), visited.end(), 0);
  if (left_out != visited.end()) {
    fail_pieces(mesh, boundary, edges[order[0]].nodes[0], edges[left_out - visited.begin()].nodes[0]);
  }
  return order;
}

}  // namespace

std::vector<std::vector<int>> pieces_of(const Mesh& mesh, int boundary) {
  const std::vector<Edge>& edges = mesh.boundaries[boundary].edges;
  UnionFind together(edges.size());
  std::unordered_map<int, int> edge_at;
  const auto before = [&](int a, int b) {
    return std::pair(mesh.nodes(a, 0), mesh.nodes(a, 1)) < std::pair(mesh.nodes(b, 0), mesh.nodes(b, 1));
  };
  std::vector<int> leftmost(edges.size());
  for (int e = 0; e < int(edges.size()); ++e) {
    for (const int end : {0, 1})
      if (const auto [at, is_new] = edge_at.emplace(edges[e].nodes[end], e); !is_new) together.join(e, at->second);
    leftmost[e] = std::min(edges[e].nodes[0], edges[e].nodes[1], before);
  }
  std::unordered_map<int, std::size_t> number;
  std::vector<std::vector<int>> pieces;
  std::vector<int> from_left(edges.size());
  std::iota(from_left.begin(), from_left.end(), 0);
  std::ranges::stable_sort(from_left, [&](int a, int b) { return before(leftmost[a], leftmost[b]); });
  for (const int e : from_left) {
    const auto [at, is_new] = number.emplace(together.find(e), pieces.size());
    if (is_new) pieces.emplace_back();
    pieces[at->second].push_back(e);
  }
  return pieces;
}

Curve contact_curve(const Mesh& mesh, int boundary) { return contact_curve(mesh, boundary, SideTable(mesh)); }

Curve contact_curve(const Mesh& mesh, int boundary, const SideTable& table) {
  const Boundary& source = mesh.boundaries[boundary];
  if (source.edges.empty()) fail(mesh, boundary, "has no edges");
  const std::vector<CellSide> sides = sides_of(mesh, source, table);
  check_one_body(mesh, boundary, sides);

  std::vector<Edge> directed;
  directed.reserve(sides.size());
  for (const CellSide& side : sides) directed.push_back(side_edge(mesh.cells[side.cell], side.side));

  Curve curve{
      .boundary = boundary, .body = mesh.cells[sides.front().cell].body, .edges = {}, .sides = {}, .closed = false};
  curve.edges.reserve(sides.size());
  curve.sides.reserve(sides.size());
  for (const std::size_t i : chain_order(mesh, boundary, directed)) {
    curve.edges.push_back(directed[i]);
    curve.sides.push_back(sides[i]);
    if (source.samples.empty()) continue;
    const bool backwards = directed[i].nodes[0] != source.edges[i].nodes[0];
    curve.samples.push_back(backwards ? reversed(source.samples[i]) : source.samples[i]);
  }
  curve.closed = curve.edges.back().nodes[1] == curve.edges.front().nodes[0];
  curve.along.assign(1, 0.0);
  for (const Edge& edge : curve.edges) curve.along.push_back(curve.along.back() + polygon_length(mesh, edge));
  return curve;
}

bool runs_backwards(const Points& nodes, const Curve& curve) {
  const std::vector<int> along = curve_nodes(curve);
  const Vec2 front = nodes.row(along.front()), back = nodes.row(along.back());
  return front.x() > back.x() || (front.x() == back.x() && front.y() > back.y());
}

bool is_end(const Curve& curve, int node) {
  return !curve.closed && (node == curve.edges.front().nodes[0] || node == curve.edges.back().nodes[1]);
}

bool meet_at_a_tip(const Curve& one, const Curve& other) {
  return is_end(other, one.edges.front().nodes[0]) || is_end(other, one.edges.back().nodes[1]);
}

std::vector<int> curve_nodes(const Curve& curve) {
  std::vector<int> nodes;
  nodes.reserve(2 * curve.edges.size() + 1);
  for (const Edge& edge : curve.edges) {
    nodes.push_back(edge.nodes[0]);
    if (edge.node_count == 3) nodes.push_back(edge.nodes[2]);
  }
  if (!curve.closed) nodes.push_back(curve.edges.back().nodes[1]);
  return nodes;
}

}  // namespace mortise
