#include "mesh/mesh.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/errors.hpp"
#include "base/printable.hpp"

namespace mortise {
namespace {

int index_of(const Mesh& mesh, const std::string& what, const std::string& name,
             const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw InputError(mesh.source + ": " + unknown_name(what, name, names));
  return static_cast<int>(found - names.begin());
}

/// One number for both directions of an edge.
std::uint64_t edge_key(int a, int b) {
  const auto [low, high] = std::minmax(a, b);
  return (static_cast<std::uint64_t>(low) << 32) | static_cast<std::uint64_t>(high);
}

/// The edges of a boundary, to be looked up by their end nodes.
class EdgeTable {
 public:
  EdgeTable(const Mesh& mesh, const Boundary& boundary) : marked_(mesh.nodes.rows(), 0) {
    rows_.reserve(boundary.edges.size());
    for (std::size_t i = 0; i < boundary.edges.size(); ++i) {
      const auto& nodes = boundary.edges[i].nodes;
      marked_[nodes[0]] = marked_[nodes[1]] = 1;
      rows_.emplace_back(edge_key(nodes[0], nodes[1]), static_cast<int>(i));
    }
    std::sort(rows_.begin(), rows_.end());
  }

  /// Index of an edge that is listed twice, or -1.
  int twice() const {
    const auto same_ends = [](const Row& a, const Row& b) { return a.first == b.first; };
    const auto found = std::adjacent_find(rows_.begin(), rows_.end(), same_ends);
    return found == rows_.end() ? -1 : found->second;
  }

  /// Index of the edge between these nodes, or -1. Nearly all cells end at the first test.
  int find(int a, int b) const {
    if (!(marked_[a] && marked_[b])) return -1;
    const std::uint64_t key = edge_key(a, b);
    const auto found = std::lower_bound(rows_.begin(), rows_.end(), Row(key, 0));
    return found != rows_.end() && found->first == key ? found->second : -1;
  }

 private:
  using Row = std::pair<std::uint64_t, int>;
  std::vector<char> marked_;  // per node: the end of some edge
  std::vector<Row> rows_;     // sorted by key
};

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

}  // namespace

int body_index(const Mesh& mesh, const std::string& name) { return index_of(mesh, "body", name, mesh.bodies); }

int boundary_index(const Mesh& mesh, const std::string& name) {
  return index_of(mesh, "boundary", name, boundary_names(mesh));
}

std::vector<std::string> boundary_names(const Mesh& mesh) {
  std::vector<std::string> names;
  names.reserve(mesh.boundaries.size());
  for (const Boundary& boundary : mesh.boundaries) names.push_back(boundary.name);
  return names;
}

Vec2 centre_of(const Points& nodes, const Cell& cell) {
  const int corners = corner_count(cell.kind);
  Vec2 centre = Vec2::Zero();
  for (int a = 0; a < corners; ++a) centre += nodes.row(cell.nodes[a]).transpose() / corners;
  return centre;
}

Edge side_edge(const Cell& cell, int side) {
  const int corners = corner_count(cell.kind);
  const int start = cell.nodes[side];
  const int end = cell.nodes[(side + 1) % corners];
  if (is_quadratic(cell.kind)) return {3, {start, end, cell.nodes[corners + side]}};
  return {2, {start, end, -1}};
}

std::vector<CellSide> sides_of(const Mesh& mesh, const Boundary& boundary) {
  const EdgeTable table(mesh, boundary);
  if (const int twice = table.twice(); twice >= 0) {
    fail_at(mesh, boundary, boundary.edges[twice], "is listed twice");
  }

  std::vector<CellSide> sides(boundary.edges.size(), CellSide{-1, -1});
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Cell& cell = mesh.cells[c];
    const int corners = corner_count(cell.kind);
    for (int side = 0; side < corners; ++side) {
      const int found = table.find(cell.nodes[side], cell.nodes[(side + 1) % corners]);
      if (found < 0) continue;
      const Edge& edge = boundary.edges[found];
      if (sides[found].cell >= 0) fail_between(mesh, boundary, edge, mesh.cells[sides[found].cell], cell);
      check_middle(mesh, boundary, edge, side_edge(cell, side));
      sides[found] = {static_cast<int>(c), side};
    }
  }

  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i].cell < 0) fail_at(mesh, boundary, boundary.edges[i], "belongs to no cell");
  }
  return sides;
}

}  // namespace mortise
