// $PhysicalNames and $Entities
#include "mesh_files/msh_sections.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

namespace mortise {
namespace {

/// An integer in front of `text`, which is shortened by it. False if there is none.
bool take_integer(std::string_view& text, int& value) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return false;
  text.remove_prefix(end - text.data());
  return true;
}

int entity_tag(MshInput& input) {
  const std::int64_t tag = input.integer("an entity's tag");
  if (tag < std::numeric_limits<int>::min() || tag > std::numeric_limits<int>::max()) {
    input.fail("the entity's tag is " + std::to_string(tag) + ", which is too large");
  }
  return static_cast<int>(tag);
}

void read_entity(MshInput& input, MshParts& parts, int dimension) {
  input.begin_record();
  const int tag = entity_tag(input);
  for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i) input.real("a coordinate of the entity");
  const auto [entity, inserted] = parts.groups_of.try_emplace({dimension, tag});
  if (!inserted) {
    input.fail("the entity of dimension " + std::to_string(dimension) + " and tag " + std::to_string(tag) +
               " is listed twice");
  }
  const std::int64_t groups = input.count("the number of physical groups", 2, 4);
  for (std::int64_t i = 0; i < groups; ++i) {
    // Reversed in a .geo, "Physical Curve("top") = {-3}", is the same curve; named twice counts once.
    const int group = static_cast<int>(std::abs(input.integer("the tag of a physical group")));
    std::vector<int>& list = entity->second;
    if (std::find(list.begin(), list.end(), group) == list.end()) list.push_back(group);
  }
  const std::int64_t boundaries = dimension == 0 ? 0 : input.count("the number of bounding entities", 2, 4);
  for (std::int64_t i = 0; i < boundaries; ++i) input.integer("the tag of a bounding entity");
  input.end_record();
}

}  // namespace

void expect_end(MshInput& input, const std::string& end) {
  if (input.at_line(end)) return;
  input.begin_record();
  std::string_view line;
  if (!input.next_line(line)) input.fail("expected " + end + ", found the end of the file");
  const std::string found(line.substr(0, 40));
  input.fail("expected " + end + " behind as many entries as the section says, found '" + found + "'");
}

void read_physical_names(MshInput& input, MshParts& parts) {
  const std::int64_t count = input.count_line("the number of names", 6, 6);
  for (std::int64_t i = 0; i < count; ++i) {
    std::string_view line;
    if (!input.next_line(line)) input.fail("expected a physical name, found the end of the file");
    std::string_view rest = line;
    int dimension = 0;
    int tag = 0;
    const bool numbers = take_integer(rest, dimension) && take_integer(rest, tag);
    const std::size_t first = rest.find('"');
    const std::size_t last = rest.rfind('"');
    if (!numbers || first == rest.npos || first == last || last + 1 != rest.size()) {
      input.fail("expected a dimension, a tag and a \"name\", found '" + std::string(line.substr(0, 80)) + "'");
    }
    const std::string name(rest.substr(first + 1, last - first - 1));
    if (!parts.names.emplace(std::pair(dimension, tag), name).second) {
      input.fail("the group of dimension " + std::to_string(dimension) + " and tag " + std::to_string(tag) +
                 " has two names");
    }
  }
}

void read_entities_4(MshInput& input, MshParts& parts) {
  parts.has_entities = true;
  input.begin_record();
  std::int64_t counts[4] = {};
  for (std::int64_t& count : counts) count = input.count("a number of entities", 8, 36);
  input.end_record();
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (std::int64_t i = 0; i < counts[dimension]; ++i) read_entity(input, parts, dimension);
  }
}

}  // namespace mortise
