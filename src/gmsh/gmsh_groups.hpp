// The physical groups of the open gmsh model.
#pragma once

#include <string>
#include <vector>

namespace mortise {

/// Tags of the groups that a curve or surface is in, ascending, each once: reversed in a .geo,
/// Physical Curve("top") = {-3}, it is the same curve. Asked of the entity: gmsh 4.8 goes through all groups to tell
/// the entities of one.
std::vector<int> groups_of_entity(int dimension, int entity);

std::string group_name(int dimension, int group);

/// As a mesh without groups has them (mesh_files/mesh_groups.hpp): where no curve is in a group each curve that bounds
/// a surface is one of its own, without a name, and where no surface is in one either each surface.
void group_by_entity();

}  // namespace mortise
