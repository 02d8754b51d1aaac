#include "gmsh/write_msh.hpp"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <unordered_map>

#include "base/errors.hpp"
#include "base/staged_file.hpp"
#include "gmsh/geo_file.hpp"
#include "mesh/box_index.hpp"
#include "mesh_files/assemble_mesh.hpp"
#include "mesh_files/element_types.hpp"
#include "mesh_files/msh_file.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

// Elements of one kind on one point, curve or surface.
struct Block {
  int dimension, entity, type, nodes_each;
  std::vector<const int*> elements;  // nodes of each
};

// Edges that belong to the same boundaries.
struct DrawnCurves {
  std::vector<std::vector<int>> boundaries;  // of each curve, ascending
  std::vector<Block> blocks;
};

DrawnCurves curves_of(const Mesh& mesh) {
  struct Named {
    const Edge* edge;
    std::vector<int> boundaries;
  };
  std::vector<Named> edges;
  std::unordered_map<std::uint64_t, std::size_t> known;
  for (std::size_t b = 0; b < mesh.boundaries.size(); ++b)
    for (const Edge& edge : mesh.boundaries[b].edges) {
      const auto [low, high] = std::minmax(edge.nodes[0], edge.nodes[1]);
      const auto [at, is_new] = known.emplace(std::uint64_t(low) << 32 | std::uint64_t(high), edges.size());
      if (is_new) edges.push_back({&edge, {}});
      edges[at->second].boundaries.push_back(int(b));
    }
  DrawnCurves curves;
  std::map<std::vector<int>, int> numbers;
  std::map<std::pair<int, int>, std::size_t> blocks;  // by curve and type
  for (const Named& named : edges) {
    const auto [number, is_new] = numbers.emplace(named.boundaries, int(numbers.size()));
    if (is_new) curves.boundaries.push_back(named.boundaries);
    const int count = named.edge->node_count;
    const auto [block, starts] = blocks.emplace(std::pair(number->second, count), curves.blocks.size());
    if (starts) curves.blocks.push_back({1, number->second + 1, line_type(count), count, {}});
    curves.blocks[block->second].elements.push_back(named.edge->nodes.data());
  }
  return curves;
}

// A named node and its points.
struct PointEntity {
  int node;
  std::vector<int> groups;  // ascending
};

std::vector<PointEntity> points_of(const Mesh& mesh) {
  std::map<int, std::vector<int>> groups;
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
    for (const int node : mesh.points[k].nodes) groups[node].push_back(int(k));
  std::vector<PointEntity> points;
  for (auto& [node, of] : groups) points.push_back({node, std::move(of)});
  return points;
}

std::vector<Block> blocks_of_cells(const Mesh& mesh) {
  std::vector<Block> blocks;
  std::map<std::pair<int, CellKind>, std::size_t> known;
  for (const Cell& cell : mesh.cells) {
    const auto [block, starts] = known.emplace(std::pair(cell.body, cell.kind), blocks.size());
    if (starts) blocks.push_back({2, cell.body + 1, cell_type(cell.kind), node_count(cell.kind), {}});
    blocks[block->second].elements.push_back(cell.nodes.data());
  }
  return blocks;
}

// Nodes of each body; of several the first has them.
std::vector<std::vector<int>> nodes_of_bodies(const Mesh& mesh) {
  std::vector<std::vector<int>> nodes(mesh.bodies.size());
  std::vector<char> taken(mesh.nodes.rows(), 0);
  for (const Cell& cell : mesh.cells)
    for (int i = 0; i < node_count(cell.kind); ++i)
      if (!std::exchange(taken[cell.nodes[i]], 1)) nodes[cell.body].push_back(cell.nodes[i]);
  for (std::vector<int>& own : nodes) std::ranges::sort(own);
  return nodes;
}

void write_groups(std::FILE* f, const std::vector<int>& groups) {
  std::fprintf(f, " %zu", groups.size());
  for (const int group : groups) std::fprintf(f, " %d", group + 1);
}

void write_points(std::FILE* f, const Mesh& mesh, const std::vector<PointEntity>& points) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    const int node = points[k].node;
    std::fprintf(f, "%zu %.17g %.17g 0", k + 1, mesh.nodes(node, 0), mesh.nodes(node, 1));
    write_groups(f, points[k].groups);
    std::fputc('\n', f);
  }
}

// With the physical groups of each, by dimension and tag.
void write_entities(std::FILE* f, const Mesh& mesh, const std::vector<std::vector<int>>& groups,
                    const std::vector<Block>& blocks) {
  std::vector<Box> boxes(groups.size());
  for (const Block& block : blocks)
    for (const int* element : block.elements)
      for (int i = 0; i < block.nodes_each; ++i)
        boxes[block.entity - 1].extend(Vec2(mesh.nodes.row(element[i]).transpose()));
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const Vec2 low = boxes[k].min(), high = boxes[k].max();
    std::fprintf(f, "%zu %.17g %.17g 0 %.17g %.17g 0", k + 1, low.x(), low.y(), high.x(), high.y());
    write_groups(f, groups[k]);
    std::fprintf(f, " 0\n");
  }
}

void write_nodes(std::FILE* f, const Mesh& mesh) {
  const std::vector<std::vector<int>> nodes = nodes_of_bodies(mesh);
  const auto count = std::size_t(mesh.nodes.rows());
  std::fprintf(f, "$Nodes\n%zu %zu 1 %zu\n", nodes.size(), count, count);
  for (std::size_t b = 0; b < nodes.size(); ++b) {
    std::fprintf(f, "2 %zu 0 %zu\n", b + 1, nodes[b].size());
    for (const int node : nodes[b]) std::fprintf(f, "%d\n", node + 1);
    for (const int node : nodes[b]) std::fprintf(f, "%.17g %.17g 0\n", mesh.nodes(node, 0), mesh.nodes(node, 1));
  }
  std::fprintf(f, "$EndNodes\n");
}

void write_elements(std::FILE* f, const std::vector<Block>& blocks) {
  std::size_t count = 0, tag = 0;
  for (const Block& block : blocks) count += block.elements.size();
  std::fprintf(f, "$Elements\n%zu %zu 1 %zu\n", blocks.size(), count, count);
  for (const Block& block : blocks) {
    std::fprintf(f, "%d %d %d %zu\n", block.dimension, block.entity, block.type, block.elements.size());
    for (const int* element : block.elements) {
      std::fprintf(f, "%zu", ++tag);
      for (int i = 0; i < block.nodes_each; ++i) std::fprintf(f, " %d", element[i] + 1);
      std::fputc('\n', f);
    }
  }
  std::fprintf(f, "$EndElements\n");
}

void write_sections(std::FILE* f, const Mesh& mesh) {
  const DrawnCurves curves = curves_of(mesh);
  const std::vector<Block> cells = blocks_of_cells(mesh);
  const std::vector<PointEntity> points = points_of(mesh);
  std::vector<std::vector<int>> surfaces;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) surfaces.push_back({int(b)});

  std::fprintf(f, "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n%zu\n",
               mesh.bodies.size() + mesh.boundaries.size() + mesh.points.size());
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
    std::fprintf(f, "0 %zu \"%s\"\n", k + 1, mesh.points[k].name.c_str());
  for (std::size_t k = 0; k < mesh.boundaries.size(); ++k)
    std::fprintf(f, "1 %zu \"%s\"\n", k + 1, mesh.boundaries[k].name.c_str());
  for (std::size_t k = 0; k < mesh.bodies.size(); ++k) std::fprintf(f, "2 %zu \"%s\"\n", k + 1, mesh.bodies[k].c_str());
  std::fprintf(f, "$EndPhysicalNames\n$Entities\n%zu %zu %zu 0\n", points.size(), curves.boundaries.size(),
               surfaces.size());
  write_points(f, mesh, points);
  write_entities(f, mesh, curves.boundaries, curves.blocks);
  write_entities(f, mesh, surfaces, cells);
  std::fprintf(f, "$EndEntities\n");
  write_nodes(f, mesh);
  std::vector<Block> blocks;
  for (std::size_t k = 0; k < points.size(); ++k) blocks.push_back({0, int(k) + 1, point_type, 1, {&points[k].node}});
  blocks.insert(blocks.end(), curves.blocks.begin(), curves.blocks.end());
  blocks.insert(blocks.end(), cells.begin(), cells.end());
  write_elements(f, blocks);
}

}  // namespace

void check_msh_target(const std::string& output, const std::vector<std::string>& inputs) {
  if (fs::path(output).extension() != ".msh") throw InputError(output + ": the name of a mesh to write ends in .msh");
  std::vector<fs::path> all;
  for (const std::string& input : inputs) {
    all.emplace_back(input);
    if (fs::path(input).extension() != ".geo") continue;
    for (const fs::path& read : geo_inputs(input)) all.push_back(read);
  }
  check_target(output, all, [](const std::string& line) { return line == "$MeshFormat"; });
}

void write_msh(const Mesh& mesh, const std::string& output) {
  const auto fail = [&](const std::string& why) { throw InputError(output + ": cannot be written: " + why); };
  StagedFile staged(output);
  const std::string path = staged.path().string();
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (!file) fail(std::strerror(errno));
  write_sections(file, mesh);
  const bool failed = std::ferror(file) != 0;
  if (std::fclose(file) != 0 || failed) fail(std::string(std::strerror(errno)) + " (is the disk full?)");
  try {
    const Mesh written = assemble_mesh(read_msh(path));
    if (written.nodes.rows() == mesh.nodes.rows() && written.cells.size() == mesh.cells.size()) return staged.commit();
  } catch (const InputError& error) {
    const std::string text = error.what();
    fail("what was written cannot be read back" + text.substr(text.starts_with(path) ? path.size() : 0));
  }
  fail("what was written is not the whole mesh");
}

}  // namespace mortise
