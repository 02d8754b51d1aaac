// $Nodes
#include "mesh_files/msh_sections.hpp"

namespace mortise {
namespace {

void read_point(MshInput& input, MshParts& parts) {
  const double x = input.real("a node's x");
  const double y = input.real("a node's y");
  const double z = input.real("a node's z");
  parts.nodes.push_back({x, y, z});
}

/// Room for the nodes that the section says.
Tags tags_for(std::int64_t count, MshParts& parts) {
  Tags tags("node");
  tags.reserve(count);
  parts.nodes.reserve(count);
  return tags;
}

void finish(const MshInput& input, const Tags& tags, MshParts& parts) {
  tags.require_once(input);
  parts.rows.emplace(tags.all());
}

/// Nodes on one entity: first all tags, then all coordinates.
void read_block(MshInput& input, Tags& tags, MshParts& parts) {
  input.begin_record();
  const std::int64_t dimension = input.integer("the dimension of the entity");
  if (dimension < 0 || dimension > 3) {
    input.fail("the dimension of the entity is " + std::to_string(dimension) + "; expected 0 to 3");
  }
  input.integer("the entity's tag");
  const std::int64_t parametric = input.integer("0 or 1 for parametric coordinates");
  const std::int64_t count = input.count("the number of nodes on the entity", 8, 32);
  input.end_record();
  for (std::int64_t i = 0; i < count; ++i) {
    input.begin_record();
    tags.add(input, input.size("a node's tag"));
  }
  for (std::int64_t i = 0; i < count; ++i) {
    input.begin_record();
    read_point(input, parts);
    for (std::int64_t k = 0; parametric != 0 && k < dimension; ++k) input.real("a parametric coordinate");
    input.end_record();
  }
}

}  // namespace

void read_nodes_2(MshInput& input, MshParts& parts) {
  const std::int64_t count = input.count_line("the number of nodes", 8, 28);
  Tags tags = tags_for(count, parts);
  for (std::int64_t i = 0; i < count; ++i) {
    input.begin_record();
    tags.add(input, input.integer("a node's tag"));
    read_point(input, parts);
    input.end_record();
  }
  finish(input, tags, parts);
}

void read_nodes_4(MshInput& input, MshParts& parts) {
  input.begin_record();
  const std::size_t header = input.record();
  const std::int64_t blocks = input.count("the number of entities with nodes", 8, 20);
  const std::int64_t count = input.count("the number of nodes", 8, 32);
  input.size("the smallest tag");
  input.size("the largest tag");
  input.end_record();
  Tags tags = tags_for(count, parts);
  for (std::int64_t b = 0; b < blocks; ++b) read_block(input, tags, parts);
  if (tags.all().size() != static_cast<std::size_t>(count)) {
    input.fail_at(
        header, "the section says " + std::to_string(count) + " nodes, but lists " + std::to_string(tags.all().size()));
  }
  finish(input, tags, parts);
}

}  // namespace mortise
