#include "io/gmsh_mesh.hpp"

#include <gmsh.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "base/errors.hpp"
#include "io/gmsh_groups.hpp"
#include "io/gmsh_session.hpp"
#include "io/orientation.hpp"
#include "mesh/place.hpp"
#include "mesh/renumber.hpp"

namespace mortise {
namespace {

/// gmsh's nodes: `row[tag]` is a row of Mesh::nodes.
struct NodeTable {
  std::vector<int> row;
  std::vector<double> z;
};

/// Tags and coordinates (x, y, z by turns) of all nodes.
struct GmshNodes {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates;
};

GmshNodes get_nodes() {
  GmshNodes nodes;
  std::vector<double> parametric;
  gmsh::model::mesh::getNodes(nodes.tags, nodes.coordinates, parametric, -1, -1, false, false);
  return nodes;
}

std::size_t largest_tag(const GmshNodes& nodes) {
  return nodes.tags.empty() ? 0 : *std::max_element(nodes.tags.begin(), nodes.tags.end());
}

NodeTable read_nodes(Mesh& mesh) {
  GmshNodes nodes = get_nodes();
  if (largest_tag(nodes) > 4 * nodes.tags.size()) {  // a .msh may number its nodes as it likes
    gmsh::model::mesh::renumberNodes();
    nodes = get_nodes();
  }

  NodeTable table;
  table.row.assign(largest_tag(nodes) + 1, -1);
  table.z.resize(nodes.tags.size());
  mesh.nodes.resize(static_cast<Eigen::Index>(nodes.tags.size()), 2);
  for (std::size_t i = 0; i < nodes.tags.size(); ++i) {
    const double* xyz = &nodes.coordinates[3 * i];
    table.row[nodes.tags[i]] = static_cast<int>(i);
    mesh.nodes.row(static_cast<Eigen::Index>(i)) << xyz[0], xyz[1];
    table.z[i] = xyz[2];
  }
  return table;
}

/// Elements of one kind on one surface or curve.
struct ElementBlock {
  int type;  ///< gmsh's number of the kind
  int node_count;
  std::vector<int> nodes;  ///< rows of Mesh::nodes, node_count an element
};

std::vector<ElementBlock> element_blocks(const NodeTable& table, int dimension, int entity) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> element_tags;
  std::vector<std::vector<std::size_t>> node_tags;
  gmsh::model::mesh::getElements(types, element_tags, node_tags, dimension, entity);

  std::vector<ElementBlock> blocks;
  for (std::size_t k = 0; k < types.size(); ++k) {
    if (element_tags[k].empty()) continue;
    ElementBlock block{types[k], static_cast<int>(node_tags[k].size() / element_tags[k].size()), {}};
    block.nodes.reserve(node_tags[k].size());
    for (const std::size_t tag : node_tags[k]) block.nodes.push_back(table.row[tag]);
    blocks.push_back(std::move(block));
  }
  return blocks;
}

[[noreturn]] void fail_kind(const Mesh& mesh, const std::string& group, const ElementBlock& block,
                            const std::string& expected) {
  std::string name;
  int dimension = 0;
  int order = 0;
  int nodes = 0;
  int primary_nodes = 0;
  std::vector<double> local;
  gmsh::model::mesh::getElementProperties(block.type, name, dimension, order, nodes, local, primary_nodes);
  throw InputError(mesh.source + ": " + group + " has elements of a kind that is not supported, '" + name + "', " +
                   near_point(mesh.nodes.row(block.nodes.front()).transpose()) + "; expected " + expected);
}

std::optional<CellKind> cell_kind(int gmsh_type) {
  switch (gmsh_type) {
    case 2:
      return CellKind::tri3;
    case 3:
      return CellKind::quad4;
    case 9:
      return CellKind::tri6;
    case 10:
      return CellKind::quad9;
    case 16:
      return CellKind::quad8;
    default:
      return std::nullopt;
  }
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

void read_body(Mesh& mesh, const NodeTable& table, const PhysicalGroup& group) {
  const int body = static_cast<int>(mesh.bodies.size());
  mesh.bodies.push_back(group.name);
  const std::size_t before = mesh.cells.size();
  for (const int surface : group.entities) {
    const std::size_t first = mesh.cells.size();
    for (const ElementBlock& block : element_blocks(table, 2, surface)) append_cells(mesh, block, body);
    orient_cells(mesh, first);
  }
  if (mesh.cells.size() == before) {
    throw InputError(mesh.source + ": physical surface '" + group.name + "' has no cells");
  }
}

void read_boundary(Mesh& mesh, const NodeTable& table, const PhysicalGroup& group) {
  Boundary boundary{group.name, {}};
  for (const int curve : group.entities) {
    for (const ElementBlock& block : element_blocks(table, 1, curve)) {
      if (block.type != 1 && block.type != 8) {
        fail_kind(mesh, "boundary '" + group.name + "'", block, "lines of 2 or 3 nodes");
      }
      for (auto node = block.nodes.begin(); node != block.nodes.end(); node += block.node_count) {
        boundary.edges.push_back({block.node_count, {node[0], node[1], block.node_count == 3 ? node[2] : -1}});
      }
    }
  }
  if (boundary.edges.empty()) {
    throw InputError(mesh.source + ": physical curve '" + group.name + "' has no edges; does it name a curve?");
  }
  mesh.boundaries.push_back(std::move(boundary));
}

/// Only nodes of cells count: a .geo may keep points of construction anywhere.
void check_plane(const Mesh& mesh, const NodeTable& table) {
  const double size = (mesh.nodes.colwise().maxCoeff() - mesh.nodes.colwise().minCoeff()).norm();
  for (const Cell& cell : mesh.cells) {
    for (int i = 0; i < node_count(cell.kind); ++i) {
      const int node = cell.nodes[i];
      if (std::abs(table.z[node]) <= 1e-9 * size) continue;
      throw InputError(mesh.source + ": body '" + mesh.bodies[cell.body] + "' leaves the plane z = 0 " +
                       near_point(mesh.nodes.row(node).transpose()) + ", z = " + std::to_string(table.z[node]));
    }
  }
}

/// The mesh that gmsh has open.
Mesh read_open_mesh(const std::string& file) {
  const std::vector<PhysicalGroup> bodies = physical_groups(file, 2);
  const std::vector<PhysicalGroup> curves = physical_groups(file, 1);
  check_surfaces(file, bodies);

  Mesh mesh;
  mesh.source = file;
  const NodeTable table = read_nodes(mesh);
  for (const PhysicalGroup& body : bodies) read_body(mesh, table, body);
  check_plane(mesh, table);
  for (const PhysicalGroup& curve : curves) read_boundary(mesh, table, curve);
  renumber(mesh);
  return mesh;
}

}  // namespace

Mesh load_mesh(const std::string& file, const std::map<std::string, double>& parameters) {
  GmshSession session;
  session.open(file, parameters);
  return read_open_mesh(file);
}

void write_msh(const std::string& file, const std::map<std::string, double>& parameters, const std::string& output) {
  namespace fs = std::filesystem;
  const fs::path target = output;
  if (target.extension() != ".msh") throw InputError(output + ": the name of a mesh to write ends in .msh");
  if (target.has_parent_path() && !fs::is_directory(target.parent_path())) {
    throw InputError(output + ": cannot be written: there is no such folder");
  }

  GmshSession session;
  session.open(file, parameters);
  read_open_mesh(file);
  fs::path staged = target;
  staged.replace_extension(std::to_string(getpid()) + ".msh");
  std::error_code error;
  try {
    session.write(staged.string());
    fs::rename(staged, target);
  } catch (const fs::filesystem_error& failure) {
    fs::remove(staged, error);
    throw InputError(output + ": cannot be written: " + failure.code().message());
  } catch (...) {
    fs::remove(staged, error);
    throw;
  }
}

}  // namespace mortise
