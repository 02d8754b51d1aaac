#include "mesh/body_points.hpp"

#include <algorithm>
#include <cassert>
#include <map>

#include "base/union_find.hpp"

namespace mortise {

BodyPoints body_points(const Mesh& mesh) {
  BodyPoints points;
  points.first.push_back(0);
  std::vector<int> last_body(mesh.nodes.rows(), -1);
  auto cell = mesh.cells.begin();
  for (int body = 0; body < int(mesh.bodies.size()); ++body) {
    for (; cell != mesh.cells.end() && cell->body == body; ++cell)
      for (int a = 0; a < node_count(cell->kind); ++a) {
        const int node = cell->nodes[a];
        if (last_body[node] == body) continue;
        last_body[node] = body;
        points.node.push_back(node);
      }
    std::sort(points.node.begin() + points.first.back(), points.node.end());
    points.first.push_back(int(points.node.size()));
  }
  return points;
}

std::vector<Cell> cells_on_points(const Mesh& mesh, const BodyPoints& points) {
  std::vector<Cell> cells = mesh.cells;
  std::vector<int> point_of_node(mesh.nodes.rows());
  int body = -1;
  for (Cell& cell : cells) {
    if (cell.body != body) {  // cells are sorted by body
      body = cell.body;
      for (int p = points.first[body]; p < points.first[body + 1]; ++p) point_of_node[points.node[p]] = p;
    }
    for (int a = 0; a < node_count(cell.kind); ++a) cell.nodes[a] = point_of_node[cell.nodes[a]];
  }
  return cells;
}

std::vector<int> bonded_to(const Mesh& mesh, const BodyPoints& points) {
  UnionFind bodies(mesh.bodies.size());
  std::vector<int> owner(mesh.nodes.rows(), -1);
  for (int body = 0; body < int(mesh.bodies.size()); ++body)
    for (int p = points.first[body]; p < points.first[body + 1]; ++p) {
      int& other = owner[points.node[p]];
      if (other < 0) other = body;
      bodies.join(other, body);
    }
  std::vector<int> first(mesh.bodies.size());
  for (int body = 0; body < int(first.size()); ++body) first[body] = bodies.find(body);
  return first;
}

std::vector<SharedNodes> shared_nodes(const Mesh& mesh, const BodyPoints& points) {
  std::map<std::pair<int, int>, std::vector<int>> nodes;  // of two bodies
  std::vector<int> owner(mesh.nodes.rows(), -1);
  for (int body = 0; body < int(mesh.bodies.size()); ++body)
    for (int p = points.first[body]; p < points.first[body + 1]; ++p) {
      const int node = points.node[p];
      if (owner[node] < 0)
        owner[node] = body;
      else
        nodes[{owner[node], body}].push_back(node);
    }
  std::vector<SharedNodes> shared;
  for (const auto& [bodies, common] : nodes)
    shared.push_back(
        {bodies.first, bodies.second, int(common.size()), mesh.nodes.row(common[common.size() / 2]).transpose()});
  return shared;
}

int point_of(const BodyPoints& points, int body, int node) {
  const auto begin = points.node.begin() + points.first[body];
  const auto end = points.node.begin() + points.first[body + 1];
  const auto found = std::lower_bound(begin, end, node);
  assert(found != end && *found == node);
  return int(found - points.node.begin());
}

}  // namespace mortise
