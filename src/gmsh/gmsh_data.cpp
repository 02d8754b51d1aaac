#include "gmsh/gmsh_data.hpp"

#include <gmsh.h>

#include <cmath>

#include "base/errors.hpp"
#include "gmsh/gmsh_curves.hpp"
#include "gmsh/gmsh_groups.hpp"
#include "mesh_files/element_types.hpp"

namespace mortise {
namespace {

TagRows get_nodes(MeshData& data) {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates;
  std::vector<double> parametric;
  gmsh::model::mesh::getNodes(tags, coordinates, parametric, -1, -1, false, false);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const double* xyz = &coordinates[3 * i];
    if (!std::isfinite(xyz[0]) || !std::isfinite(xyz[1]) || !std::isfinite(xyz[2])) {
      throw InputError(data.file + ": gmsh, meshing: the node " + std::to_string(tags[i]) +
                       " has coordinates that are not finite");
    }
    data.nodes.push_back({xyz[0], xyz[1], xyz[2]});
  }
  return TagRows(std::vector<std::int64_t>(tags.begin(), tags.end()));
}

void get_elements(MeshData& data, const TagRows& rows, int dimension, int entity, const std::vector<int>& groups,
                  const Vec2& shift) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> element_tags;
  std::vector<std::vector<std::size_t>> node_tags;
  gmsh::model::mesh::getElements(types, element_tags, node_tags, dimension, entity);
  for (std::size_t k = 0; k < types.size(); ++k) {
    ElementBlock block{.dimension = dimension, .entity = entity, .type = types[k], .groups = groups, .nodes = {}};
    block.nodes.reserve(node_tags[k].size());
    for (const std::size_t tag : node_tags[k]) block.nodes.push_back(rows.find(static_cast<std::int64_t>(tag)));
    if (!groups.empty() && is_line(block.type)) sample_curve(data.nodes, node_tags[k], shift, block);
    data.blocks.push_back(std::move(block));
  }
}

}  // namespace

MeshData gmsh_data(const std::string& file, const Vec2& shift, const std::map<int, std::vector<int>>& drawn) {
  MeshData data;
  data.file = file;
  const TagRows rows = get_nodes(data);
  for (const int dimension : {0, 1, 2}) {
    gmsh::vectorpair groups, entities;
    gmsh::model::getPhysicalGroups(groups, dimension);
    for (const auto& [dim, group] : groups) data.groups.push_back({dim, group, group_name(dim, group)});
    gmsh::model::getEntities(entities, dimension);
    for (const auto& [dim, entity] : entities) {
      const auto as_drawn = dim == 1 ? drawn.find(entity) : drawn.end();
      get_elements(data, rows, dim, entity, as_drawn != drawn.end() ? as_drawn->second : groups_of_entity(dim, entity),
                   shift);
    }
  }
  move(-shift, data);
  return data;
}

}  // namespace mortise
