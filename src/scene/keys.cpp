#include "scene/keys.hpp"

#include <utility>

namespace mortise::scene_file {
namespace {

std::string default_of(const Key& key) {
  if (!key.otherwise.empty()) return key.otherwise;
  if (!key.missing.empty()) return "required";
  if (key.fallback.is_null()) return "";
  const std::string value = key.fallback.dump();
  return key.fallback.is_number() ? value : "`" + value + "`";
}

}  // namespace

Key required(Key key, const std::string& expected) {
  key.missing = expected;
  key.fallback = {};
  return key;
}

void expect_keys(const Node& table, const Keys& keys) {
  std::vector<std::string> known;
  for (const Key& key : keys) known.push_back(key.name);
  expect_keys(table, known);
}

void read(const Node& table, const Keys& keys) {
  expect_keys(table, keys);
  for (const Key& key : keys) {
    const Node* node = find(table, key.name);
    if (node == nullptr && !key.missing.empty()) require(table, key.name, key.missing);
    if (node != nullptr && key.read) key.read(*node);
  }
}

void check(const Keys& keys, const std::string& path) {
  for (const Key& key : keys)
    if (const std::string trouble = key.trouble ? key.trouble() : ""; !trouble.empty())
      throw SceneError(path + "." + key.name + ": " + trouble);
}

Json object_of(const Keys& keys) {
  Json object{{"type", "object"}, {"additionalProperties", false}};
  Json properties = Json::object();
  for (const Key& key : keys) {
    if (!key.missing.empty()) object["required"].push_back(key.name);
    Json& property = properties[key.name];
    if (!key.words.empty()) property["description"] = key.words;
    if (!key.fallback.is_null()) property["default"] = key.fallback;
    property.update(key.schema);
  }
  object["properties"] = std::move(properties);
  return object;
}

Json object_of(const Keys& keys, const std::vector<std::vector<std::string>>& groups) {
  Json object = object_of(keys);
  for (const auto& group : groups) object["oneOf"].push_back({{"required", group}});
  return object;
}

std::string markdown_rows(const Keys& keys, const std::string& prefix) {
  std::string rows;
  for (const Key& key : keys) rows += "| `" + prefix + key.name + "` | " + key.words + " | " + default_of(key) + " |\n";
  return rows;
}

}  // namespace mortise::scene_file
