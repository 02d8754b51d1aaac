// $Nodes
#include "mesh_files/msh_sections.hpp"

namespace mortise {
namespace {

/// Nodes and their tags while they are read.
class Nodes {
 public:
  Nodes(MshInput& input, MshParts& parts, std::int64_t count) : input_(input), parts_(parts) {
    tags_.reserve(count);
    records_.reserve(count);
    parts_.nodes.reserve(count);
  }

  void add_tag(std::int64_t tag) {
    if (tag <= 0) input_.fail("the node's tag is " + std::to_string(tag) + "; expected a number > 0");
    tags_.push_back(tag);
    records_.push_back(input_.record());
  }

  void read_point() {
    const double x = input_.real("a node's x");
    const double y = input_.real("a node's y");
    const double z = input_.real("a node's z");
    parts_.nodes.push_back({x, y, z});
  }

  void finish() {
    if (const std::int64_t repeated = first_repeated(tags_); repeated >= 0) {
      input_.fail_at(records_[repeated], "the node " + std::to_string(tags_[repeated]) + " is listed twice");
    }
    parts_.rows.emplace(tags_);
  }

  std::size_t size() const { return tags_.size(); }

 private:
  MshInput& input_;
  MshParts& parts_;
  std::vector<std::int64_t> tags_;
  std::vector<std::size_t> records_;  // where each tag stands
};

/// Nodes on one entity: first all tags, then all coordinates.
void read_block(MshInput& input, Nodes& nodes) {
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
    nodes.add_tag(input.size("a node's tag"));
  }
  for (std::int64_t i = 0; i < count; ++i) {
    input.begin_record();
    nodes.read_point();
    for (std::int64_t k = 0; parametric != 0 && k < dimension; ++k) input.real("a parametric coordinate");
    input.end_record();
  }
}

}  // namespace

void read_nodes_2(MshInput& input, MshParts& parts) {
  const std::int64_t count = input.count_line("the number of nodes", 8, 28);
  Nodes nodes(input, parts, count);
  for (std::int64_t i = 0; i < count; ++i) {
    input.begin_record();
    nodes.add_tag(input.integer("a node's tag"));
    nodes.read_point();
    input.end_record();
  }
  nodes.finish();
}

void read_nodes_4(MshInput& input, MshParts& parts) {
  input.begin_record();
  const std::size_t header = input.record();
  const std::int64_t blocks = input.count("the number of entities with nodes", 8, 20);
  const std::int64_t count = input.count("the number of nodes", 8, 32);
  input.size("the smallest tag");
  input.size("the largest tag");
  input.end_record();
  Nodes nodes(input, parts, count);
  for (std::int64_t b = 0; b < blocks; ++b) read_block(input, nodes);
  if (nodes.size() != static_cast<std::size_t>(count)) {
    input.fail_at(header,
                  "the section says " + std::to_string(count) + " nodes, but lists " + std::to_string(nodes.size()));
  }
  nodes.finish();
}

}  // namespace mortise
