#include "scene/overrides.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "base/errors.hpp"
#include "scene/fail.hpp"
#include "scene/fields.hpp"
#include "scene/schema.hpp"

namespace mortise::scene_file {
namespace {

using Parts = std::vector<std::string>;

bool is_index(const std::string& part) {
  return !part.empty() && std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::string count_of_entries(std::size_t count) {
  if (count == 0) return "there are 0 entries";
  if (count == 1) return "there is 1 entry (index 0)";
  return "there are " + std::to_string(count) + " entries (index 0 to " + std::to_string(count - 1) + ")";
}

[[noreturn]] void fail_index(const Change& setting, const std::string& path, const std::string& part,
                             std::size_t count) {
  const std::string trouble =
      is_index(part) ? "no entry with index " + part : "expected an index, found '" + part + "'";
  fail(setting.place, path, trouble + "; " + count_of_entries(count));
}

Node& item_at(Node& list, const std::string& part, const Change& setting) {
  std::size_t index = list.items.size();
  if (is_index(part)) std::from_chars(part.data(), part.data() + part.size(), index);
  if (index >= list.items.size()) fail_index(setting, list.path, part, list.items.size());
  return list.items[index];
}

/// An override changes entries, it cannot add one by its index.
bool is_list_of_entries(const std::string& path) {
  return std::ranges::any_of(
      sections(), [&](const Section& section) { return section.name == path && section.schema["type"] == "array"; });
}

Node& create_table(Node& parent, const std::string& part, const Change& setting) {
  Node table;
  table.name = part;
  table.path = join_path(parent.path, part);
  table.place = setting.place;
  parent.items.push_back(std::move(table));
  return parent.items.back();
}

/// The entry of a table or item of a list that `part` leads to; a new table if the table has no such entry.
Node& step(Node& node, const std::string& part, const Change& setting) {
  if (node.kind == Node::Kind::list) return item_at(node, part, setting);
  if (node.kind != Node::Kind::table) {
    fail(setting.place, node.path, "is " + describe(node) + ", so there is no '" + part + "' in it; expected a table");
  }
  for (Node& entry : node.items) {
    if (entry.name == part) return entry;
  }
  return create_table(node, part, setting);
}

void set(Node& root, const Change& setting) {
  Node* node = &root;
  for (std::size_t i = 0; i < setting.parts.size(); ++i) {
    const std::string& part = setting.parts[i];
    const bool leads_on = i + 1 < setting.parts.size();
    if (leads_on && i == 0 && is_list_of_entries(part) && find(root, part) == nullptr) {
      fail_index(setting, part, setting.parts[1], 0);
    }
    node = &step(*node, part, setting);
  }
  *node = setting.value(*node);
}

/// contact.KEY, which stands for that key of every pair.
bool means_every_pair(const Parts& parts, const Node* contacts) {
  return parts.size() > 1 && parts[0] == "contact" && !is_index(parts[1]) && contacts != nullptr &&
         contacts->kind == Node::Kind::list && !contacts->items.empty();
}

}  // namespace

void apply(Node& root, Change change) {
  const Node* contacts = find(root, "contact");
  if (!means_every_pair(change.parts, contacts)) {
    set(root, change);
    return;
  }
  const std::size_t count = contacts->items.size();
  change.parts.insert(change.parts.begin() + 1, "");
  for (std::size_t i = 0; i < count; ++i) {
    change.parts[1] = std::to_string(i);
    set(root, change);
  }
}

void apply_override(Node& root, const Override& change) {
  Place place = root.place;
  place.setting = "--set " + change.key + "=" + change.value;
  const Parts parts = split_key(change.key);
  if (parts.empty()) {
    fail(place, "",
         "'" + change.key.substr(0, 80) +
             "' is not a dotted key; expected one such as method.kind or boundary.2.pressure");
  }
  apply(root, {parts, place, [&](const Node& spot) { return parse_value(change.value, spot, place); }});
}

}  // namespace mortise::scene_file

namespace mortise {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

Override parse_override(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string key = trimmed(text.substr(0, equals));
  if (equals == std::string::npos || key.empty()) {
    scene_file::Place place;
    place.file = "--set '" + text + "'";
    scene_file::fail(place, "", "expected KEY=VALUE, for example method.kind=ddm");
  }
  return {key, trimmed(text.substr(equals + 1))};
}

}  // namespace mortise
