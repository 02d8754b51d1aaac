#include "support/patches.hpp"

#include <cmath>
#include <map>
#include <numbers>

namespace mortise::test {
namespace {

class Grid {
 public:
  Grid(const Patch& patch, std::vector<Vec2>& nodes) : patch_(patch), nodes_(nodes) {}

  // Numbers on the grid of half elements.
  int node(int i, int j) {
    if (patch_.closed) i %= 2 * patch_.n;
    const auto [it, added] = numbers_.emplace(std::pair(i, j), int(nodes_.size()));
    if (added) nodes_.push_back(patch_.map(0.5 * i / patch_.n, 0.5 * j / patch_.m));
    return it->second;
  }
  // Two steps from (i, j) to the next vertex.
  Edge edge(int i, int j, int di, int dj, bool quadratic) {
    return {quadratic ? 3 : 2, {node(i, j), node(i + 2 * di, j + 2 * dj), quadratic ? node(i + di, j + dj) : -1}};
  }

 private:
  const Patch& patch_;
  std::vector<Vec2>& nodes_;
  std::map<std::pair<int, int>, int> numbers_;
};

void add(const Patch& p, CellKind kind, std::vector<Vec2>& nodes, Mesh& mesh) {
  Grid grid(p, nodes);
  const bool quadratic = kind == CellKind::quad8;
  const int body = int(mesh.bodies.size());
  mesh.bodies.push_back(p.name);
  for (int j = 0; j < 2 * p.m; j += 2)
    for (int i = 0; i < 2 * p.n; i += 2) {
      Cell cell{kind, body, {grid.node(i, j), grid.node(i + 2, j), grid.node(i + 2, j + 2), grid.node(i, j + 2)}};
      if (quadratic) {
        cell.nodes[4] = grid.node(i + 1, j);
        cell.nodes[5] = grid.node(i + 2, j + 1);
        cell.nodes[6] = grid.node(i + 1, j + 2);
        cell.nodes[7] = grid.node(i, j + 1);
      }
      mesh.cells.push_back(cell);
    }
  Boundary south{p.name + "_south", {}}, north{p.name + "_north", {}}, west{p.name + "_west", {}},
      east{p.name + "_east", {}}, all{p.name + "_all", {}};
  for (int i = 0; i < 2 * p.n; i += 2) {
    south.edges.push_back(grid.edge(i, 0, 1, 0, quadratic));
    north.edges.push_back(grid.edge(i, 2 * p.m, 1, 0, quadratic));
  }
  for (int j = 0; j < 2 * p.m; j += 2) {
    west.edges.push_back(grid.edge(0, j, 0, 1, quadratic));
    east.edges.push_back(grid.edge(2 * p.n, j, 0, 1, quadratic));
  }
  std::vector<Boundary> sides{south, north};
  if (!p.closed) {
    sides.insert(sides.end(), {west, east});
    for (const Boundary& side : sides) all.edges.insert(all.edges.end(), side.edges.begin(), side.edges.end());
    sides.push_back(all);
  }
  mesh.boundaries.insert(mesh.boundaries.end(), sides.begin(), sides.end());
}

}  // namespace

Mesh mesh_of(const std::vector<Patch>& patches, CellKind kind) {
  Mesh mesh;
  mesh.source = "patches";
  std::vector<Vec2> nodes;
  for (const Patch& p : patches) add(p, kind, nodes, mesh);
  mesh.nodes.resize(Eigen::Index(nodes.size()), 2);
  for (std::size_t i = 0; i < nodes.size(); ++i) mesh.nodes.row(i) = nodes[i].transpose();
  return mesh;
}

Patch ring(const std::string& name, int n, int m, const Vec2& centre, double r0, double r1, double from, double to) {
  const auto map = [=](double a, double b) {
    const double angle = (from + a * (to - from)) * std::numbers::pi / 180, r = r0 + b * (r1 - r0);
    return Vec2(centre + r * Vec2(std::cos(angle), std::sin(angle)));
  };
  return {name, n, m, map, from - to == 360};
}

Patch block(const std::string& name, int n, int m, double a, double b, std::function<double(double)> bottom,
            std::function<double(double)> top) {
  const auto map = [=](double s, double t) {
    const double x = a + s * (b - a);
    return Vec2(x, bottom(x) + t * (top(x) - bottom(x)));
  };
  return {name, n, m, map};
}

}  // namespace mortise::test
