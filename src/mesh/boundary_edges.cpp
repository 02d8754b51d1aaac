#include "mesh/boundary_edges.hpp"

#include <algorithm>
#include <utility>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "base/union_find.hpp"
#include "mesh/side_table.hpp"

namespace mortise {
namespace {

[[noreturn]] void fail_twice(const Mesh& mesh, const Cell& a, const Cell& b) {
  Vec2 centre = Vec2::Zero();
  const int corners = corner_count(b.kind);
  for (int i = 0; i < corners; ++i) centre += mesh.nodes.row(b.nodes[i]).transpose() / corners;
  throw InputError(mesh.source + ": two elements lie on the same side of an edge, one over the other, " +
                   near_point(centre) + " (bodies '" + mesh.bodies[a.body] + "' and '" + mesh.bodies[b.body] +
                   "'); expected each element once, in one body");
}

/// The other cells at the same two nodes: in the same body, in another body. Throws where one lies on the same side.
struct Neighbours {
  int same_body = -1, other_body = -1;
};

Neighbours neighbours(const Mesh& mesh, const SideTable& table, int node, const SideAtNode& half) {
  Neighbours found;
  const Cell& cell = mesh.cells[half.side.cell];
  for (const SideAtNode& other : table.at(node)) {
    if (other.other != half.other || other.side.cell == half.side.cell) continue;
    const Cell& neighbour = mesh.cells[other.side.cell];
    if (other.starts == half.starts) fail_twice(mesh, neighbour, cell);
    (neighbour.body == cell.body ? found.same_body : found.other_body) = other.side.cell;
  }
  return found;
}

std::pair<int, int> ends(const Edge& edge) { return std::minmax(edge.nodes[0], edge.nodes[1]); }

}  // namespace

BoundaryEdges boundary_edges(const Mesh& mesh) {
  const SideTable table(mesh);
  UnionFind pieces(mesh.cells.size());  // cells that hang together
  BoundaryEdges result;
  for (int node = 0; node < mesh.nodes.rows(); ++node)
    for (const SideAtNode& half : table.at(node)) {
      if (half.other < node) continue;  // each side at the smaller one of its nodes
      const Cell& cell = mesh.cells[half.side.cell];
      const auto [same_body, other_body] = neighbours(mesh, table, node, half);
      if (same_body >= 0)
        pieces.join(same_body, half.side.cell);
      else
        result.edges.push_back({side_edge(cell, half.side.side), half.side, cell.body, -1, other_body >= 0});
    }

  std::vector<int> number(mesh.cells.size(), -1);
  result.piece_of_cell.resize(mesh.cells.size());
  for (int c = 0; c < int(mesh.cells.size()); ++c) {
    int& piece = number[pieces.find(c)];
    if (piece < 0) piece = result.pieces++;
    result.piece_of_cell[c] = piece;
  }
  for (BoundaryEdge& edge : result.edges) edge.piece = result.piece_of_cell[edge.side.cell];
  std::stable_sort(result.edges.begin(), result.edges.end(),
                   [](const BoundaryEdge& a, const BoundaryEdge& b) { return a.piece < b.piece; });
  return result;
}

std::vector<std::vector<int>> names_of(const Mesh& mesh, const std::vector<BoundaryEdge>& edges) {
  using Row = std::pair<std::pair<int, int>, int>;  // the ends of a named edge, the name
  std::vector<Row> rows;
  for (int b = 0; b < int(mesh.boundaries.size()); ++b)
    for (const Edge& edge : mesh.boundaries[b].edges) rows.emplace_back(ends(edge), b);
  std::sort(rows.begin(), rows.end());
  std::vector<std::vector<int>> names(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const std::pair<int, int> key = ends(edges[i].edge);
    for (auto row = std::lower_bound(rows.begin(), rows.end(), Row(key, -1)); row != rows.end() && row->first == key;
         ++row)
      names[i].push_back(row->second);
  }
  return names;
}

}  // namespace mortise
