// $Elements
#include <tuple>

#include "mesh_files/element_types.hpp"
#include "mesh_files/msh_sections.hpp"

namespace mortise {
namespace {

/// Elements while they are read.
class Elements {
 public:
  Elements(MshInput& input, MshParts& parts, std::int64_t count) : input_(input), parts_(parts) {
    tags_.reserve(count);
  }

  const ElementType& type(std::int64_t number) const {
    const bool possible = number > 0 && number < 1000;
    const ElementType* known = possible ? element_type(static_cast<int>(number)) : nullptr;
    if (known == nullptr) {
      input_.fail("there is no kind of element with the number " + std::to_string(number) +
                  " (or it has no fixed number of nodes)");
    }
    return *known;
  }

  void add_tag(std::int64_t tag) { tags_.add(input_, tag); }

  /// The block of such elements; null for elements that are neither points nor lines nor surfaces. `group` 0 is none.
  ElementBlock* block(const ElementType& type, std::int64_t entity, std::int64_t group) {
    if (type.dimension() > 2) return nullptr;
    const Key key{type.number, entity, group};
    if (last_ != nullptr && key == last_key_) return last_;
    const auto [found, inserted] = index_.try_emplace(key, parts_.blocks.size());
    if (inserted) {
      parts_.blocks.push_back({type.dimension(), static_cast<int>(entity), type.number, {}, {}});
      if (group > 0) parts_.blocks.back().groups.push_back(static_cast<int>(group));
    }
    last_key_ = key;
    last_ = &parts_.blocks[found->second];
    return last_;
  }

  /// Of the element whose tag came last.
  void read_nodes(const ElementType& type, ElementBlock* block, bool wide) {
    for (int i = 0; i < type.node_count; ++i) {
      const std::int64_t tag = wide ? input_.size("a node's tag") : input_.integer("a node's tag");
      const int row = parts_.rows->find(tag);
      if (row < 0) {
        input_.fail("the node " + std::to_string(tag) + " of the element " + std::to_string(tags_.all().back()) +
                    " is not in $Nodes");
      }
      if (block != nullptr) block->nodes.push_back(row);
    }
  }

  void finish() const { tags_.require_once(input_); }

  std::size_t size() const { return tags_.all().size(); }

 private:
  using Key = std::tuple<int, std::int64_t, std::int64_t>;  // type, entity, group

  MshInput& input_;
  MshParts& parts_;
  std::map<Key, std::size_t> index_;
  Key last_key_;
  ElementBlock* last_ = nullptr;  // a new block moves the others: then it is asked for anew
  Tags tags_{"element"};
};

/// What format 2.2 says of an element beside its kind and nodes.
struct ElementTags {
  std::int64_t group = 0, entity = 0;
};

ElementTags read_tags(MshInput& input, std::int64_t count) {
  ElementTags tags;
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t tag = input.integer("a tag of the element");
    if (i == 0) tags.group = std::abs(tag);  // reversed curves have negative ones
    if (i == 1) tags.entity = tag;
  }
  return tags;
}

void check_tag_count(const MshInput& input, std::int64_t count) {
  if (count < 0) input.fail("the number of tags is " + std::to_string(count) + "; expected 0 or more");
}

void read_text_2(MshInput& input, Elements& elements, std::int64_t count) {
  for (std::int64_t i = 0; i < count; ++i) {
    input.begin_record();
    elements.add_tag(input.integer("an element's tag"));
    const ElementType& type = elements.type(input.integer("an element's kind"));
    const std::int64_t tag_count = input.integer("the number of tags");
    check_tag_count(input, tag_count);
    const ElementTags tags = read_tags(input, tag_count);
    elements.read_nodes(type, elements.block(type, tags.entity, tags.group), false);
    input.end_record();
  }
}

/// In runs of elements of one kind, with a header each.
void read_binary_2(MshInput& input, Elements& elements, std::int64_t count) {
  while (static_cast<std::int64_t>(elements.size()) < count) {
    input.begin_record();
    const ElementType& type = elements.type(input.integer("an element's kind"));
    const std::int64_t run = input.integer("the number of elements of a kind");
    const std::int64_t tag_count = input.integer("the number of tags");
    check_tag_count(input, tag_count);
    if (run < 1 || run > count - static_cast<std::int64_t>(elements.size())) {
      input.fail("says " + std::to_string(run) + " elements of a kind follow, where 1 to " +
                 std::to_string(count - static_cast<std::int64_t>(elements.size())) + " are left");
    }
    for (std::int64_t i = 0; i < run; ++i) {
      input.begin_record();
      elements.add_tag(input.integer("an element's tag"));
      const ElementTags tags = read_tags(input, tag_count);
      elements.read_nodes(type, elements.block(type, tags.entity, tags.group), false);
    }
  }
}

/// Elements of one kind on one entity.
void read_block(MshInput& input, const MshParts& parts, Elements& elements) {
  input.begin_record();
  const std::int64_t dimension = input.integer("the dimension of the entity");
  const std::int64_t entity = input.integer("the entity's tag");
  const ElementType& type = elements.type(input.integer("the elements' kind"));
  if (type.dimension() != dimension) {
    input.fail("elements of the kind '" + type.name() + "' on an entity of dimension " + std::to_string(dimension));
  }
  const bool known = parts.groups_of.contains({type.dimension(), static_cast<int>(entity)});
  if (parts.has_entities && !known) {
    input.fail("the entity of dimension " + std::to_string(dimension) + " and tag " + std::to_string(entity) +
               " is not in $Entities");
  }
  const std::int64_t count = input.count("the number of elements on the entity", 4, 16);
  input.end_record();
  ElementBlock* block = elements.block(type, entity, 0);
  for (std::int64_t i = 0; i < count; ++i) {
    input.begin_record();
    elements.add_tag(input.size("an element's tag"));
    elements.read_nodes(type, block, true);
    input.end_record();
  }
}

}  // namespace

void read_elements_2(MshInput& input, MshParts& parts) {
  const std::int64_t count = input.count_line("the number of elements", 8, 12);
  Elements elements(input, parts, count);
  if (input.binary()) {
    read_binary_2(input, elements, count);
  } else {
    read_text_2(input, elements, count);
  }
  elements.finish();
}

void read_elements_4(MshInput& input, MshParts& parts) {
  input.begin_record();
  const std::size_t header = input.record();
  const std::int64_t blocks = input.count("the number of entities with elements", 8, 20);
  const std::int64_t count = input.count("the number of elements", 4, 16);
  input.size("the smallest tag");
  input.size("the largest tag");
  input.end_record();
  Elements elements(input, parts, count);
  for (std::int64_t b = 0; b < blocks; ++b) read_block(input, parts, elements);
  if (elements.size() != static_cast<std::size_t>(count)) {
    input.fail_at(header, "the section says " + std::to_string(count) + " elements, but lists " +
                              std::to_string(elements.size()));
  }
  elements.finish();
}

}  // namespace mortise
