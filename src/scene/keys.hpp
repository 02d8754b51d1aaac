// The table of keys: what each table of a scene may say, a row a key. A row reads the value into a member, checks the
// member of a scene that no file gave, and stands in scene.schema.json and in the table of docs/files.md.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "scene/kinds.hpp"

namespace mortise::scene_file {

struct Key {
  std::string name;
  Json schema;                              ///< of the value
  std::string words;                        ///< what it says, one line of Markdown
  std::string otherwise{};                  ///< what counts without it, the same; empty: `fallback`
  Json fallback{};                          ///< the value of the member without it; null: none that can be written
  std::string missing{};                    ///< of a key that must be there: what is expected, for the message
  std::function<void(const Node&)> read{};  ///< sets the member; none: the section's own function does
  std::function<std::string()> trouble{};   ///< of the member's value, "expected ..., found ..."; empty: none
};

/// The rows of a table. Rows hold references to what they read into.
using Keys = std::vector<Key>;

/// As it stands in a page; null of what has no short form, and of an empty text.
template <class T>
Json json_of(const T& value) {
  if constexpr (std::is_enum_v<T>) return to_string(value);
  if constexpr (std::is_same_v<T, std::string>) return value.empty() ? Json() : Json(value);
  if constexpr (std::is_same_v<T, bool>) return value;
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, int>) return plain(value);
  return {};
}

/// A key whose value is read into `member`.
template <class T>
Key key(const std::string& name, T& member, const Kind<T>& kind, const std::string& words,
        const std::string& otherwise = {}) {
  Key row{name, kind.schema, words, otherwise, json_of(member)};
  row.read = [&member, read = kind.read](const Node& node) { member = read(node); };
  if (kind.trouble) row.trouble = [&member, trouble = kind.trouble] { return trouble(member); };
  return row;
}

/// The same of one that may be left out.
template <class T>
Key key(const std::string& name, std::optional<T>& member, const Kind<T>& kind, const std::string& words,
        const std::string& otherwise = "none") {
  Key row{name, kind.schema, words, otherwise};
  row.read = [&member, read = kind.read](const Node& node) { member = read(node); };
  if (kind.trouble) row.trouble = [&member, trouble = kind.trouble] { return member ? trouble(*member) : ""; };
  return row;
}

/// A key that must be there; `expected` is for the message if it is not.
Key required(Key key, const std::string& expected);

/// Throws InputError unless `table` is a table whose every key is a row's; names the nearest.
void expect_keys(const Node& table, const Keys& keys);

/// Reads all rows that read for themselves. Throws InputError: `table` is none, has a key that is no row's, lacks one
/// that must be there, or a value is not as expected.
void read(const Node& table, const Keys& keys);

/// Throws SceneError "PATH.NAME: expected ..., found ..." for the first member out of its range.
void check(const Keys& keys, const std::string& path);

/// The JSON Schema of a table with these rows.
Json object_of(const Keys& keys);

/// The same, of which exactly one of some groups of keys is there.
Json object_of(const Keys& keys, const std::vector<std::vector<std::string>>& groups);

/// Rows of the page, "| `PREFIX.name` | words | default |", a line each.
std::string markdown_rows(const Keys& keys, const std::string& prefix);

}  // namespace mortise::scene_file
