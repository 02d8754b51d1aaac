#include "mesh/boundary_edges.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "base/union_find.hpp"

namespace mortise {
namespace {

/// A cell's side, at the node of its two that has the smaller number.
struct Half {
  int other;     ///< the node with the larger number
  bool forward;  ///< the side runs from the smaller number to the larger
  CellSide side;
};

/// All sides by their smaller node: those of node i are halves[first[i]] .. halves[first[i + 1] - 1].
struct SideTable {
  std::vector<int> first;
  std::vector<Half> halves;
};

template <class Visit>
void for_each_side(const Mesh& mesh, const Visit& visit) {
  for (int c = 0; c < int(mesh.cells.size()); ++c) {
    const Cell& cell = mesh.cells[c];
    const int corners = corner_count(cell.kind);
    for (int side = 0; side < corners; ++side)
      visit(cell.nodes[side], cell.nodes[(side + 1) % corners], CellSide{c, side});
  }
}

SideTable side_table(const Mesh& mesh) {
  SideTable table;
  table.first.assign(mesh.nodes.rows() + 1, 0);
  for_each_side(mesh, [&](int a, int b, const CellSide&) { ++table.first[std::min(a, b) + 1]; });
  std::partial_sum(table.first.begin(), table.first.end(), table.first.begin());
  table.halves.resize(table.first.back());
  std::vector<int> next(table.first.begin(), table.first.end() - 1);
  for_each_side(mesh, [&](int a, int b, const CellSide& side) {
    table.halves[next[std::min(a, b)]++] = {std::max(a, b), a < b, side};
  });
  return table;
}

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

Neighbours neighbours(const Mesh& mesh, const SideTable& table, int node, const Half& half) {
  Neighbours found;
  const Cell& cell = mesh.cells[half.side.cell];
  for (int k = table.first[node]; k < table.first[node + 1]; ++k) {
    const Half& other = table.halves[k];
    if (other.other != half.other || other.side.cell == half.side.cell) continue;
    const Cell& neighbour = mesh.cells[other.side.cell];
    if (other.forward == half.forward) fail_twice(mesh, neighbour, cell);
    (neighbour.body == cell.body ? found.same_body : found.other_body) = other.side.cell;
  }
  return found;
}

std::pair<int, int> ends(const Edge& edge) { return std::minmax(edge.nodes[0], edge.nodes[1]); }

}  // namespace

BoundaryEdges boundary_edges(const Mesh& mesh) {
  const SideTable table = side_table(mesh);
  UnionFind pieces(mesh.cells.size());  // cells that hang together
  BoundaryEdges result;
  for (int node = 0; node < mesh.nodes.rows(); ++node)
    for (int k = table.first[node]; k < table.first[node + 1]; ++k) {
      const Half& half = table.halves[k];
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
