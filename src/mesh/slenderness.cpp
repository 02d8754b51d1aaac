#include "mesh/slenderness.hpp"

#include <algorithm>
#include <limits>
#include <queue>

#include "base/union_find.hpp"
#include "base/vectors.hpp"

namespace mortise {
namespace {

// From corner to corner, within cells.
struct Way {
  int to;
  double length;
};

using Ways = std::vector<std::vector<Way>>;

void add_ways(const Mesh& mesh, const Cell& cell, Ways& ways) {
  for (int i = 0; i < corner_count(cell.kind); ++i)
    for (int j = 0; j < i; ++j) {
      const int a = cell.nodes[i], b = cell.nodes[j];
      const double length = (mesh.nodes.row(a) - mesh.nodes.row(b)).norm();
      ways[a].push_back({b, length});
      ways[b].push_back({a, length});
    }
}

double area_of(const Mesh& mesh, const Cell& cell) {
  double twice = 0;
  const int corners = corner_count(cell.kind);
  for (int i = 0; i < corners; ++i)
    twice += cross(mesh.nodes.row(cell.nodes[i]), mesh.nodes.row(cell.nodes[(i + 1) % corners]));
  return std::abs(twice) / 2;
}

// The corner that is farthest from another of its piece by the shortest way (Dijkstra 1959), and how far.
Way farthest_from(int first, const Ways& ways, std::vector<double>& distance) {
  const auto nearer = [](const Way& a, const Way& b) { return a.length > b.length; };
  std::priority_queue<Way, std::vector<Way>, decltype(nearer)> next(nearer);
  std::vector<int> reached;
  const auto reach = [&](const Way& way) {
    if (!(way.length < distance[way.to])) return;
    if (distance[way.to] == std::numeric_limits<double>::infinity()) reached.push_back(way.to);
    distance[way.to] = way.length;
    next.push(way);
  };
  reach({first, 0});
  Way last{first, 0};
  while (!next.empty()) {
    const Way way = next.top();
    next.pop();
    if (way.length > distance[way.to]) continue;
    last = way;
    for (const Way& on : ways[way.to]) reach({on.to, way.length + on.length});
  }
  for (const int corner : reached) distance[corner] = std::numeric_limits<double>::infinity();
  return last;
}

}  // namespace

std::vector<double> slenderness(const Mesh& mesh) {
  const std::size_t count = mesh.nodes.rows();
  UnionFind joined(count);
  Ways ways(count);
  for (const Cell& cell : mesh.cells) {
    for (int a = 1; a < node_count(cell.kind); ++a) joined.join(cell.nodes[0], cell.nodes[a]);
    add_ways(mesh, cell, ways);
  }
  std::vector<double> area(count, 0);
  for (const Cell& cell : mesh.cells) area[joined.find(cell.nodes[0])] += area_of(mesh, cell);

  std::vector<double> found(count, 0), distance(count, std::numeric_limits<double>::infinity());
  for (const Cell& cell : mesh.cells) {
    const int piece = joined.find(cell.nodes[0]);
    if (found[piece] > 0) continue;
    const double longest = farthest_from(farthest_from(cell.nodes[0], ways, distance).to, ways, distance).length;
    found[piece] = longest * longest / area[piece];
  }
  for (int node = 0; node < int(count); ++node) found[node] = found[joined.find(node)];
  return found;
}

}  // namespace mortise
