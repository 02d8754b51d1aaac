#include "mesh_files/mesh_groups.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "base/types.hpp"

namespace mortise {
namespace {

constexpr std::array section_kinds{"point", "curve", "surface"};  // by dimension

/// The node of these elements that is nearest to the middle of them all, for messages.
std::string near_block(const MeshData& data, const ElementBlock& block) {
  Eigen::AlignedBox2d box;
  const auto point = [&](int node) { return Vec2(data.nodes[node][0], data.nodes[node][1]); };
  for (const int node : block.nodes) box.extend(point(node));
  const Vec2 middle = 0.5 * (box.min() + box.max());
  const auto nearer = [&](int a, int b) {
    return (point(a) - middle).squaredNorm() < (point(b) - middle).squaredNorm();
  };
  return near_point(point(*std::min_element(block.nodes.begin(), block.nodes.end(), nearer)));
}

void check_name(const MeshData& data, const PhysicalGroup& group, const std::string& what) {
  if (printable(group.name) != group.name) {
    throw InputError(data.file + ": " + what + ": the name '" + printable(group.name) +
                     "' has characters that cannot be shown; expected one line of text");
  }
}

void check_names(const MeshData& data, int dimension) {
  std::map<std::string, int> tag_of;
  for (const PhysicalGroup& group : data.groups) {
    if (group.dimension != dimension) continue;
    const std::string what = std::string("physical ") + section_kinds[dimension] + " " + std::to_string(group.tag);
    check_name(data, group, what);
    const auto [found, inserted] = tag_of.emplace(group.name, group.tag);
    if (!inserted) {
      throw InputError(data.file + ": " + what + " and " + std::to_string(found->second) + " have the same name '" +
                       group.name + "'");
    }
  }
}

std::string name_by_tag(int dimension, int tag) { return section_kinds[dimension] + ("_" + std::to_string(tag)); }

std::string name_of(const MeshData& data, int body) {
  for (const PhysicalGroup& group : data.groups) {
    if (group.dimension == 2 && group.tag == body) return group.name;
  }
  return "";
}

void check_surfaces(const MeshData& data) {
  const bool any = std::any_of(data.groups.begin(), data.groups.end(), [](const auto& g) { return g.dimension == 2; });
  if (!any) throw InputError(data.file + ": no physical surface; a body is a Physical Surface(\"name\") = {...}");
  for (const ElementBlock& block : data.blocks) {
    if (block.dimension != 2 || block.nodes.empty() || block.groups.size() == 1) continue;
    const std::string what =
        data.file + ": surface " + std::to_string(block.entity) + " " + near_block(data, block) + " is in ";
    if (block.groups.empty()) {
      throw InputError(what + "no physical surface; every meshed surface belongs to a body");
    }
    throw InputError(what + "two bodies, '" + name_of(data, block.groups[0]) + "' and '" +
                     name_of(data, block.groups[1]) + "'");
  }
}

}  // namespace

void name_groups(MeshData& data) {
  for (PhysicalGroup& group : data.groups) {
    if (!group.name.empty()) continue;
    group.name = name_by_tag(group.dimension, group.tag);
    if (group.dimension > 0) data.named_by_tag = true;
  }
}

void group_by_entity(MeshData& data) {
  if (std::ranges::any_of(data.groups, [](const PhysicalGroup& group) { return group.dimension > 0; })) return;
  std::set<std::pair<int, int>> entities;
  for (ElementBlock& block : data.blocks) {
    if (block.dimension == 0 || block.nodes.empty()) continue;
    block.groups = {block.entity};
    entities.emplace(block.dimension, block.entity);
  }
  for (const auto& [dimension, entity] : entities) data.groups.push_back({dimension, entity, ""});
}

void group_the_rest(MeshData& data) {
  std::vector<char> of_cells(data.nodes.size(), 0);
  int last = 0;
  for (const PhysicalGroup& group : data.groups) last = std::max(last, group.tag);
  for (const ElementBlock& block : data.blocks)
    if (block.dimension == 2)
      for (const int node : block.nodes) of_cells[node] = 1;
  std::map<std::pair<int, int>, int> tags;  // of new groups, by dimension and entity
  for (ElementBlock& block : data.blocks) {
    if (block.dimension == 0 || !block.groups.empty() || block.nodes.empty()) continue;
    if (!std::ranges::all_of(block.nodes, [&](int node) { return of_cells[node] != 0; })) continue;
    const auto [found, inserted] = tags.emplace(std::pair(block.dimension, block.entity), last + 1);
    if (inserted) data.groups.push_back({block.dimension, ++last, name_by_tag(block.dimension, block.entity)});
    block.groups = {found->second};
  }
}

void check_groups(const MeshData& data) {
  check_names(data, 2);
  check_names(data, 1);
  check_names(data, 0);
  check_surfaces(data);
}

}  // namespace mortise
