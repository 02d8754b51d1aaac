#include <algorithm>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "contact/segments.hpp"
#include "fem/edges.hpp"
#include "problem/audit_lines.hpp"

namespace mortise {
namespace {

// An edge and who loads it.
struct LoadedEdge {
  std::pair<int, int> ends;
  const BoundarySpec* entry;
  int boundary, edge;
};

std::vector<LoadedEdge> loaded_edges(const Mesh& mesh, const std::vector<BoundaryEntry>& entries) {
  std::vector<LoadedEdge> list;
  for (const BoundaryEntry& entry : entries) {
    if (!is_load(entry.spec.what)) continue;
    for (const NamedBoundary& on : entry.curves)
      for (int e = 0; e < int(mesh.boundaries[on.boundary].edges.size()); ++e) {
        const auto& nodes = mesh.boundaries[on.boundary].edges[e].nodes;
        list.push_back({std::minmax(nodes[0], nodes[1]), &entry.spec, on.boundary, e});
      }
  }
  std::stable_sort(list.begin(), list.end(), [](const auto& x, const auto& y) { return x.ends < y.ends; });
  return list;
}

}  // namespace

void refuse_double_loads(const Mesh& mesh, const std::vector<BoundaryEntry>& entries) {
  const std::vector<LoadedEdge> list = loaded_edges(mesh, entries);
  const auto same = [](const LoadedEdge& x, const LoadedEdge& y) { return x.ends == y.ends; };
  const auto first = std::adjacent_find(list.begin(), list.end(), same);
  if (first == list.end()) return;
  const auto second = first + 1;
  double length = 0;
  for (auto it = first; it + 1 != list.end(); ++it)
    if (same(*it, *(it + 1))) length += edge_length(mesh.nodes, mesh.boundaries[it->boundary].edges[it->edge]);
  const auto what = [&](const LoadedEdge& e) {
    return e.entry->key + " on '" + mesh.boundaries[e.boundary].name + "'";
  };
  const Edge& edge = mesh.boundaries[first->boundary].edges[first->edge];
  const Vec2 middle = (mesh.nodes.row(edge.nodes[0]) + mesh.nodes.row(edge.nodes[1])) / 2;
  throw SceneError(worded(what(*first), " and ", what(*second), " load the same edges, ", near_point(middle),
                          " and over a length of ", length,
                          " in all: they would add up; expected at most one load on each edge"));
}

}  // namespace mortise
