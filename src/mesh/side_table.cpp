#include "mesh/side_table.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/errors.hpp"
#include "base/printable.hpp"

namespace mortise {
namespace {

template <class Visit>
void for_each_side(const Mesh& mesh, const Visit& visit) {
  for (int c = 0; c < int(mesh.cells.size()); ++c) {
    const Cell& cell = mesh.cells[c];
    const int corners = corner_count(cell.kind);
    for (int side = 0; side < corners; ++side)
      visit(cell.nodes[side], cell.nodes[(side + 1) % corners], CellSide{c, side});
  }
}

[[noreturn]] void fail_at(const Mesh& mesh, const Boundary& boundary, const Edge& edge, const std::string& trouble) {
  const Vec2 middle = 0.5 * (mesh.nodes.row(edge.nodes[0]) + mesh.nodes.row(edge.nodes[1])).transpose();
  throw InputError(mesh.source + ": boundary '" + boundary.name + "': the edge " + near_point(middle) + " " + trouble);
}

/// The ends agree already; a middle node that differs would leave a slit between the edge and its cell.
void check_middle(const Mesh& mesh, const Boundary& boundary, const Edge& edge, const Edge& side) {
  if (edge.node_count != side.node_count) {
    fail_at(mesh, boundary, edge,
            "has " + std::to_string(edge.node_count) + " nodes, but the side of its cell has " +
                std::to_string(side.node_count) + "; expected one order for the whole mesh");
  }
  if (edge.node_count == 3 && edge.nodes[2] != side.nodes[2]) {
    fail_at(mesh, boundary, edge, "has another middle node than its cell");
  }
}

[[noreturn]] void fail_between(const Mesh& mesh, const Boundary& boundary, const Edge& edge, const Cell& first,
                               const Cell& second) {
  if (first.body == second.body) {
    fail_at(mesh, boundary, edge,
            "lies between two cells of body '" + mesh.bodies[first.body] + "'; expected an edge of its boundary");
  }
  fail_at(mesh, boundary, edge,
          "belongs to both bodies '" + mesh.bodies[first.body] + "' and '" + mesh.bodies[second.body] +
              "'; expected bodies with nodes of their own (in a .geo: a curve for each body, no Coherence)");
}

// Index of an edge that is listed twice, or -1.
int listed_twice(const Boundary& boundary) {
  std::vector<std::pair<std::pair<int, int>, int>> ends;
  for (int i = 0; i < int(boundary.edges.size()); ++i) {
    const auto& nodes = boundary.edges[i].nodes;
    ends.emplace_back(std::minmax({nodes[0], nodes[1]}), i);
  }
  std::ranges::sort(ends);
  const auto found = std::ranges::adjacent_find(ends, {}, [](const auto& edge) { return edge.first; });
  return found == ends.end() ? -1 : found->second;
}

}  // namespace

SideTable::SideTable(const Mesh& mesh) : first_(mesh.nodes.rows() + 1, 0) {
  for_each_side(mesh, [&](int a, int b, const CellSide&) {
    ++first_[a + 1];
    ++first_[b + 1];
  });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  sides_.resize(first_.back());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for_each_side(mesh, [&](int a, int b, const CellSide& side) {
    sides_[next[a]++] = {b, true, side};
    sides_[next[b]++] = {a, false, side};
  });
}

std::vector<CellSide> sides_of(const Mesh& mesh, const Boundary& boundary, const SideTable& table) {
  if (const int twice = listed_twice(boundary); twice >= 0)
    fail_at(mesh, boundary, boundary.edges[twice], "is listed twice");
  std::vector<CellSide> sides;
  sides.reserve(boundary.edges.size());
  for (const Edge& edge : boundary.edges) {
    CellSide found{-1, -1};
    for (const auto& [other, starts, side] : table.at(edge.nodes[0])) {
      if (other != edge.nodes[1]) continue;
      const Cell& cell = mesh.cells[side.cell];
      if (found.cell >= 0) fail_between(mesh, boundary, edge, mesh.cells[found.cell], cell);
      check_middle(mesh, boundary, edge, side_edge(cell, side.side));
      found = side;
    }
    if (found.cell < 0) fail_at(mesh, boundary, edge, "belongs to no cell");
    sides.push_back(found);
  }
  return sides;
}

std::vector<CellSide> sides_of(const Mesh& mesh, const Boundary& boundary) {
  return sides_of(mesh, boundary, SideTable(mesh));
}

}  // namespace mortise
