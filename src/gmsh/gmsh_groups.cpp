#include "gmsh/gmsh_groups.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cstdlib>

namespace mortise {

std::vector<int> groups_of_entity(int dimension, int entity) {
  std::vector<int> groups;
  gmsh::model::getPhysicalGroupsForEntity(dimension, entity, groups);
  for (int& group : groups) group = std::abs(group);
  std::ranges::sort(groups);
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  return groups;
}

std::string group_name(int dimension, int group) {
  std::string name;
  gmsh::model::getPhysicalName(dimension, group, name);
  return name;
}

}  // namespace mortise
