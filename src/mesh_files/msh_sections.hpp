// The sections of a .msh, one by one, for msh_file.cpp.
#pragma once

#include <map>
#include <optional>
#include <utility>

#include "mesh_files/mesh_data.hpp"
#include "mesh_files/msh_input.hpp"
#include "mesh_files/tags.hpp"

namespace mortise {

/// The sections read so far. An entity or a group is a pair: dimension, tag.
struct MshParts {
  std::map<std::pair<int, int>, std::string> names;           ///< of physical groups
  std::map<std::pair<int, int>, std::vector<int>> groups_of;  ///< format 4.1: of each entity
  bool has_entities = false;                                  ///< format 4.1: whether $Entities is there
  std::vector<std::array<double, 3>> nodes;                   ///< x, y, z
  std::optional<TagRows> rows;                                ///< once $Nodes is read
  std::vector<ElementBlock> blocks;
};

/// Throws unless `end`, such as "$EndNodes", comes next.
void expect_end(MshInput& input, const std::string& end);

/// Each is called behind the line of the section's name, and reads up to its $End line, which is the caller's.
/// They throw InputError.
void read_physical_names(MshInput& input, MshParts& parts);
void read_entities_4(MshInput& input, MshParts& parts);
void read_nodes_2(MshInput& input, MshParts& parts);
void read_nodes_4(MshInput& input, MshParts& parts);
void read_elements_2(MshInput& input, MshParts& parts);
void read_elements_4(MshInput& input, MshParts& parts);

}  // namespace mortise
