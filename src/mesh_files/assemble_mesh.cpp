#include "mesh_files/assemble_mesh.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "base/each_once.hpp"
#include "base/errors.hpp"
#include "base/printable.hpp"
#include "mesh/orientation.hpp"
#include "mesh/renumber.hpp"
#include "mesh_files/element_types.hpp"
#include "mesh_files/mesh_groups.hpp"
#include "mesh_files/repeated.hpp"

namespace mortise {
namespace {

[[noreturn]] void fail_kind(const Mesh& mesh, const std::string& group, const ElementBlock& block,
                            const std::string& expected) {
  throw InputError(mesh.source + ": " + group + " has elements of a kind that is not supported, '" +
                   element_type(block.type)->name() + "', " +
                   near_point(mesh.nodes.row(block.nodes.front()).transpose()) + "; expected " + expected);
}

void append_cells(Mesh& mesh, const ElementBlock& block, int body) {
  const std::optional<CellKind> kind = cell_kind(block.type);
  if (!kind) {
    fail_kind(mesh, "body '" + mesh.bodies[body] + "'", block,
              "triangles of 3 or 6 nodes, quadrilaterals of 4, 8 or 9");
  }
  const int count = node_count(*kind);
  for (auto node = block.nodes.begin(); node != block.nodes.end(); node += count) {
    Cell cell{*kind, body, {}};
    cell.nodes.fill(-1);
    std::copy_n(node, count, cell.nodes.begin());
    mesh.cells.push_back(cell);
  }
}

/// The blocks of each physical group (dimension, tag), by entity.
using BlocksOf = std::map<std::pair<int, int>, std::vector<const ElementBlock*>>;

BlocksOf blocks_by_group(const MeshData& data) {
  BlocksOf blocks;
  for (const ElementBlock& block : data.blocks) {
    if (block.nodes.empty()) continue;
    for (const int group : block.groups) blocks[{block.dimension, group}].push_back(&block);
  }
  return blocks;
}

/// Cells that ran the other way round than the rest of their surface.
struct Turned {
  std::size_t count = 0;
  std::string body;  // the first one with such cells
};

/// Of the cells from `first` on. Only nodes of cells count: a .geo may keep points of construction anywhere.
void check_plane(const Mesh& mesh, const MeshData& data, std::size_t first, double size) {
  for (std::size_t c = first; c < mesh.cells.size(); ++c) {
    const Cell& cell = mesh.cells[c];
    for (int i = 0; i < node_count(cell.kind); ++i) {
      const int node = cell.nodes[i];
      const double z = data.nodes[node][2];
      if (std::abs(z) <= 1e-9 * size) continue;
      throw InputError(mesh.source + ": body '" + mesh.bodies[cell.body] + "' leaves the plane z = 0 " +
                       near_point(mesh.nodes.row(node).transpose()) + ", z = " + std::to_string(z) +
                       "; expected a plane mesh");
    }
  }
}

void add_body(Mesh& mesh, Turned& turned, const MeshData& data, const PhysicalGroup& group,
              const std::vector<const ElementBlock*>& blocks, double size) {
  const int body = static_cast<int>(mesh.bodies.size());
  mesh.bodies.push_back(group.name);
  if (blocks.empty()) throw InputError(data.file + ": physical surface '" + group.name + "' has no cells");
  std::size_t first = mesh.cells.size();
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    append_cells(mesh, *blocks[k], body);
    check_plane(mesh, data, first, size);
    if (k + 1 < blocks.size() && blocks[k + 1]->entity == blocks[k]->entity) continue;
    const std::size_t count = orient_cells(mesh, first);
    if (turned.count == 0 && count > 0) turned.body = group.name;
    turned.count += count;
    first = mesh.cells.size();
  }
}

void add_boundary(Mesh& mesh, const MeshData& data, const PhysicalGroup& group,
                  const std::vector<const ElementBlock*>& blocks) {
  Boundary boundary{group.name, {}};
  for (const ElementBlock* block : blocks) {
    if (!is_line(block->type)) {
      fail_kind(mesh, "boundary '" + group.name + "'", *block, "lines of 2 or 3 nodes");
    }
    const int count = line_node_count(block->type);
    for (auto node = block->nodes.begin(); node != block->nodes.end(); node += count) {
      boundary.edges.push_back({count, {node[0], node[1], count == 3 ? node[2] : -1}});
    }
    boundary.samples.insert(boundary.samples.end(), block->samples.begin(), block->samples.end());
    if (boundary.undrawn.empty()) boundary.undrawn = block->undrawn;
  }
  if (boundary.samples.size() != boundary.edges.size()) boundary.samples.clear();  // all of them, or none
  if (boundary.edges.empty()) {
    throw InputError(data.file + ": physical curve '" + group.name + "' has no edges; does it name a curve?");
  }
  mesh.boundaries.push_back(std::move(boundary));
}

void add_point(Mesh& mesh, const PhysicalGroup& group, const std::vector<const ElementBlock*>& blocks) {
  std::vector<int> nodes;
  for (const ElementBlock* block : blocks) nodes.insert(nodes.end(), block->nodes.begin(), block->nodes.end());
  keep_each_once(nodes);
  mesh.points.push_back({group.name, std::move(nodes)});
}

/// A mesh in the plane x-z or y-z.
void check_not_upright(const MeshData& data) {
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-low[0]);
  for (const ElementBlock& block : data.blocks) {
    if (block.dimension != 2) continue;
    for (const int node : block.nodes)
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], data.nodes[node][k]);
        high[k] = std::max(high[k], data.nodes[node][k]);
      }
  }
  const auto extent = [&](int k) { return high[k] - low[k]; };
  const double size = std::max({extent(0), extent(1), extent(2)});
  for (const int k : {0, 1}) {
    if (!(extent(2) > 1e-9 * size) || !(extent(k) <= 1e-9 * size)) continue;
    throw InputError(data.file + ": the bodies lie in the plane " + (k == 0 ? "y-z" : "x-z") + ", " + "xy"[k] + " = " +
                     std::to_string(low[k]) + "; expected them in x-y: exchange z and " + "xy"[k]);
  }
}

}  // namespace

Mesh assemble_mesh(MeshData data) {
  std::stable_sort(data.blocks.begin(), data.blocks.end(), [](const ElementBlock& a, const ElementBlock& b) {
    return std::tie(a.dimension, a.entity, a.type) < std::tie(b.dimension, b.entity, b.type);
  });
  std::stable_sort(data.groups.begin(), data.groups.end(),
                   [](const PhysicalGroup& a, const PhysicalGroup& b) { return a.tag < b.tag; });
  name_groups(data);
  check_groups(data);

  Mesh mesh;
  mesh.source = data.file;
  mesh.notes = data.notes;
  mesh.named_by_tag = data.named_by_tag;
  mesh.nodes.resize(static_cast<Eigen::Index>(data.nodes.size()), 2);
  for (std::size_t i = 0; i < data.nodes.size(); ++i) {
    mesh.nodes.row(static_cast<Eigen::Index>(i)) << data.nodes[i][0], data.nodes[i][1];
  }
  check_not_upright(data);
  const double size = (mesh.nodes.colwise().maxCoeff() - mesh.nodes.colwise().minCoeff()).norm();
  Turned turned;
  BlocksOf blocks = blocks_by_group(data);
  for (const PhysicalGroup& group : data.groups) {
    if (group.dimension == 2) add_body(mesh, turned, data, group, blocks[{2, group.tag}], size);
  }
  if (turned.count > 0)
    mesh.notes.push_back(std::to_string(turned.count) + " cells, the first of body '" + turned.body +
                         "', ran the other way round than the rest of their surface and were turned");
  for (const PhysicalGroup& group : data.groups) {
    if (group.dimension == 1) add_boundary(mesh, data, group, blocks[{1, group.tag}]);
    if (group.dimension == 0) add_point(mesh, group, blocks[{0, group.tag}]);
  }
  check_no_repetition(mesh);
  renumber(mesh);
  return mesh;
}

}  // namespace mortise
