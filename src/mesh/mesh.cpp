#include "mesh/mesh.hpp"

#include <algorithm>

#include "base/errors.hpp"

namespace mortise {
namespace {

int index_of(const Mesh& mesh, const std::string& what, const std::string& name,
             const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw InputError(mesh.source + ": " + unknown_name(what, name, names));
  return static_cast<int>(found - names.begin());
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

}  // namespace mortise
