#include "gmsh/gmsh_groups.hpp"

#include <gmsh.h>

#include <cstdlib>

#include "base/each_once.hpp"

namespace mortise {

std::vector<int> groups_of_entity(int dimension, int entity) {
  std::vector<int> groups;
  gmsh::model::getPhysicalGroupsForEntity(dimension, entity, groups);
  for (int& group : groups) group = std::abs(group);
  keep_each_once(groups);
  return groups;
}

std::string group_name(int dimension, int group) {
  std::string name;
  gmsh::model::getPhysicalName(dimension, group, name);
  return name;
}

void group_by_entity() {
  gmsh::vectorpair groups, surfaces, curves;
  gmsh::model::getPhysicalGroups(groups, 1);
  if (!groups.empty()) return;
  gmsh::model::getEntities(surfaces, 2);
  gmsh::model::getBoundary(surfaces, curves, false, false);
  keep_each_once(curves);
  gmsh::model::getPhysicalGroups(groups, 2);
  if (!groups.empty()) surfaces.clear();
  for (const gmsh::vectorpair& entities : {curves, surfaces})
    for (const auto& [dimension, tag] : entities) gmsh::model::addPhysicalGroup(dimension, {tag}, tag);
}

}  // namespace mortise
