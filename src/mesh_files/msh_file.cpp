#include "mesh_files/msh_file.hpp"

#include <set>

#include "mesh_files/msh_sections.hpp"

namespace mortise {
namespace {

enum class Format { v2, v4 };

/// $MeshFormat, with which every .msh begins.
Format read_format(MshInput& input) {
  std::string_view line;
  if (!input.next_line(line) || line != "$MeshFormat") {
    input.fail("this is no .msh: expected $MeshFormat, found " +
               (line.empty() ? "nothing" : "'" + std::string(line.substr(0, 40)) + "'"));
  }
  input.set_section("$MeshFormat");
  input.begin_record();
  const double version = input.real("the version of the format");
  const std::int64_t kind = input.integer("0 for text or 1 for binary");
  const std::int64_t size = input.integer("the size of a number");
  input.end_line();
  const bool v2 = version >= 2 && version < 3;
  if (!v2 && version != 4.1) {
    input.fail("a version of the format that is not supported; expected 2.2 or 4.1 (gmsh FILE -save -format msh41)");
  }
  if ((kind != 0 && kind != 1) || size != 8) {
    input.fail("expected 0 for text or 1 for binary, then 8 for the size of a number");
  }
  if (kind == 1) {
    input.set_binary(true);
    input.begin_record();
    if (input.integer("the number 1") != 1) {
      input.fail("binary of the other byte order; expected little-endian (or text: gmsh FILE -save -format msh41)");
    }
  }
  expect_end(input, "$EndMeshFormat");
  return v2 ? Format::v2 : Format::v4;
}

/// False for a section that is not needed.
bool read_section(MshInput& input, const std::string& name, Format format, MshParts& parts) {
  const bool v2 = format == Format::v2;
  if (name == "PartitionedEntities") input.fail("a partitioned mesh; expected one that is not partitioned");
  if (name == "Elements" && !parts.rows) input.fail("the elements stand before the nodes");
  if (name == "PhysicalNames") {
    read_physical_names(input, parts);
  } else if (name == "Entities" && !v2) {
    read_entities_4(input, parts);
  } else if (name == "Nodes") {
    v2 ? read_nodes_2(input, parts) : read_nodes_4(input, parts);
  } else if (name == "Elements") {
    v2 ? read_elements_2(input, parts) : read_elements_4(input, parts);
  } else {
    return false;
  }
  expect_end(input, "$End" + name);
  return true;
}

void read_sections(MshInput& input, Format format, MshParts& parts) {
  std::set<std::string> seen{"MeshFormat"};
  std::string_view line;
  while (input.set_section(""), input.next_line(line)) {
    if (line.size() < 2 || line[0] != '$' || line.starts_with("$End")) {
      input.fail("expected a section such as $Nodes, found '" + std::string(line.substr(0, 40)) + "'");
    }
    const std::string name(line.substr(1));
    const std::size_t start = input.record();
    input.set_section("$" + name);
    const bool known =
        name == "MeshFormat" || name == "PhysicalNames" || name == "Entities" || name == "Nodes" || name == "Elements";
    if (known && !seen.insert(name).second) input.fail("the section comes a second time");
    if (!read_section(input, name, format, parts) && !input.skip_to("$End" + name)) {
      input.fail_at(start, "the section has no $End" + name);
    }
  }
  for (const char* needed : {"Nodes", "Elements"}) {
    if (!seen.contains(needed)) input.fail(std::string("the file has no section $") + needed);
  }
}

/// Groups of dimension 0, 1 and 2 that entities or elements belong to.
void add_groups(MshParts& parts, MeshData& data) {
  std::set<std::pair<int, int>> used;
  for (const auto& [entity, groups] : parts.groups_of) {
    for (const int group : groups) used.emplace(entity.first, group);
  }
  for (ElementBlock& block : data.blocks) {
    const auto found = parts.groups_of.find({block.dimension, block.entity});
    if (found != parts.groups_of.end()) block.groups = found->second;
    for (const int group : block.groups) used.emplace(block.dimension, group);
  }
  for (const auto& [dimension, tag] : used) {
    if (dimension >= 0 && dimension <= 2) data.groups.push_back({dimension, tag, parts.names[{dimension, tag}]});
  }
}

}  // namespace

MeshData read_msh(const std::string& file) {
  MshInput input(file);
  MshParts parts;
  const Format format = read_format(input);
  read_sections(input, format, parts);
  MeshData data{file, std::move(parts.nodes), {}, std::move(parts.blocks)};
  add_groups(parts, data);
  return data;
}

}  // namespace mortise
