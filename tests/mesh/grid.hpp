// Meshes built by hand for tests: a rectangle of unit squares in any kind of cell.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh.hpp"

namespace mortise::testing_meshes {

/// Gives the points of a half-unit lattice their numbers as they come.
class Lattice {
 public:
  int node(int i, int j) {
    const auto [found, inserted] = numbers_.emplace(std::pair(i, j), static_cast<int>(points_.size()));
    if (inserted) points_.emplace_back(0.5 * i, 0.5 * j);
    return found->second;
  }
  Points points() const {
    Points rows(static_cast<Eigen::Index>(points_.size()), 2);
    for (std::size_t k = 0; k < points_.size(); ++k) rows.row(static_cast<Eigen::Index>(k)) = points_[k].transpose();
    return rows;
  }

 private:
  std::map<std::pair<int, int>, int> numbers_;
  std::vector<Vec2> points_;
};

/// A cell from its corners (lattice coordinates), with middles and centre as its kind wants.
inline Cell make_cell(Lattice& lattice, CellKind kind, int body, const std::vector<std::pair<int, int>>& corners) {
  Cell cell{kind, body, {}};
  cell.nodes.fill(-1);
  int count = 0;
  for (const auto& [i, j] : corners) cell.nodes[count++] = lattice.node(i, j);
  if (!is_quadratic(kind)) return cell;
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    const auto& [i0, j0] = corners[k];
    const auto& [i1, j1] = corners[(k + 1) % n];
    cell.nodes[count++] = lattice.node((i0 + i1) / 2, (j0 + j1) / 2);
  }
  if (kind == CellKind::quad9) cell.nodes[8] = lattice.node(corners[0].first + 1, corners[0].second + 1);
  return cell;
}

inline Edge make_edge(Lattice& lattice, CellKind kind, std::pair<int, int> a, std::pair<int, int> b) {
  const int start = lattice.node(a.first, a.second);
  const int end = lattice.node(b.first, b.second);
  if (!is_quadratic(kind)) return {2, {start, end, -1}};
  return {3, {start, end, lattice.node((a.first + b.first) / 2, (a.second + b.second) / 2)}};
}

/// [0, nx] x [0, ny], one body "plate"; boundaries bottom, right, top, left, and "all" four.
inline Mesh plate(CellKind kind, int nx, int ny) {
  Lattice lattice;
  Mesh mesh;
  mesh.source = "plate.msh";
  mesh.bodies = {"plate"};
  for (int j = 0; j < 2 * ny; j += 2) {
    for (int i = 0; i < 2 * nx; i += 2) {
      const std::pair a(i, j), b(i + 2, j), c(i + 2, j + 2), d(i, j + 2);
      if (corner_count(kind) == 4) {
        mesh.cells.push_back(make_cell(lattice, kind, 0, {a, b, c, d}));
      } else {
        mesh.cells.push_back(make_cell(lattice, kind, 0, {a, b, c}));
        mesh.cells.push_back(make_cell(lattice, kind, 0, {a, c, d}));
      }
    }
  }
  mesh.boundaries = {{"bottom", {}}, {"right", {}}, {"top", {}}, {"left", {}}, {"all", {}}};
  const auto add = [&](int boundary, std::pair<int, int> a, std::pair<int, int> b) {
    mesh.boundaries[boundary].edges.push_back(make_edge(lattice, kind, a, b));
    mesh.boundaries[4].edges.push_back(make_edge(lattice, kind, a, b));
  };
  for (int i = 0; i < 2 * nx; i += 2) {
    add(0, {i, 0}, {i + 2, 0});
    add(2, {i, 2 * ny}, {i + 2, 2 * ny});  // against the body's direction
  }
  for (int j = 0; j < 2 * ny; j += 2) {
    add(1, {2 * nx, j}, {2 * nx, j + 2});
    add(3, {0, j}, {0, j + 2});
  }
  mesh.nodes = lattice.points();
  return mesh;
}

inline const std::vector<CellKind>& all_kinds() {
  static const std::vector<CellKind> kinds{CellKind::tri3, CellKind::tri6, CellKind::quad4, CellKind::quad8,
                                           CellKind::quad9};
  return kinds;
}

/// Where a node is.
inline Vec2 at(const Mesh& mesh, int node) { return mesh.nodes.row(node).transpose(); }

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace mortise::testing_meshes
