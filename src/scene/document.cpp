// The only file that knows toml++.
#include "scene/document.hpp"

// toml++ 3.3 asserts, in debug builds, on some text that it goes on to refuse properly, for example "[#".
#define TOML_ASSERT(condition) static_assert(true)
#define TOML_MAX_NESTED_VALUES 32  // lists and inline tables in one another
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <utility>

#include "base/printable.hpp"
#include "scene/fail.hpp"

namespace mortise::scene_file {
namespace {

Node convert(const toml::node& source, std::string name, std::string path, const Place& document);

std::vector<Node> convert_entries(const toml::table& table, const std::string& path, const Place& document) {
  using Entry = std::pair<toml::source_position, Node>;
  std::vector<Entry> entries;
  for (const auto& [key, value] : table) {
    const std::string name{key.str()};
    entries.emplace_back(key.source().begin, convert(value, name, join_path(path, name), document));
  }
  // toml++ sorts by name; we keep the order of the file.
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.first < b.first; });
  std::vector<Node> nodes;
  for (Entry& entry : entries) nodes.push_back(std::move(entry.second));
  return nodes;
}

std::vector<Node> convert_items(const toml::array& array, const std::string& path, const Place& document) {
  std::vector<Node> nodes;
  for (const toml::node& item : array) {
    const std::string index = std::to_string(nodes.size());
    nodes.push_back(convert(item, index, join_path(path, index), document));
  }
  return nodes;
}

std::string date_text(const toml::node& source) {
  std::ostringstream text;
  source.visit([&text](const auto& value) {
    if constexpr (toml::is_chronological<decltype(value)>) text << *value;
  });
  return text.str();
}

void convert_scalar(const toml::node& source, Node& node) {
  if (const auto* text = source.as_string()) {
    node.kind = Node::Kind::string;
    node.text = text->get();
    // Of one in single quotation marks, with nothing escaped.
    const toml::source_region& at = source.source();
    if (at.begin.line == at.end.line && at.end.column - at.begin.column == node.text.size() + 2)
      node.column = int(at.begin.column) + 1;
  } else if (const auto* integer = source.as_integer()) {
    node.kind = Node::Kind::number;
    node.number = static_cast<double>(integer->get());
    node.text = std::to_string(integer->get());
  } else if (const auto* real = source.as_floating_point()) {
    node.kind = Node::Kind::number;
    node.number = real->get();
    node.text = shortest(real->get());
  } else if (const auto* boolean = source.as_boolean()) {
    node.kind = Node::Kind::boolean;
    node.text = boolean->get() ? "true" : "false";
  } else {
    node.kind = Node::Kind::date;
    node.text = date_text(source);
  }
}

/// `document` is the place of the whole document; the line is added unless it is an override or a row of a table.
Node convert(const toml::node& source, std::string name, std::string path, const Place& document) {
  Node node;
  node.name = std::move(name);
  node.path = std::move(path);
  node.place = document;
  if (document.setting.empty() && document.line == 0) node.place.line = static_cast<int>(source.source().begin.line);
  if (const auto* table = source.as_table()) {
    node.kind = Node::Kind::table;
    node.items = convert_entries(*table, node.path, document);
  } else if (const auto* array = source.as_array()) {
    node.kind = Node::Kind::list;
    node.items = convert_items(*array, node.path, document);
  } else {
    convert_scalar(source, node);
  }
  return node;
}

constexpr int deepest_key = 32;

/// Position of the quote that closes the one at `i`, or `i` if none does on its line, nearby.
std::size_t end_of_quoted(const std::string& text, std::size_t i) {
  const std::size_t last = std::min(text.size(), i + 4096);
  for (std::size_t end = i + 1; end < last && text[end] != '\n'; ++end) {
    if (text[end] == text[i]) return end;
    if (text[end] == '\\' && text[i] == '"') ++end;
  }
  return i;
}

/// Whether some key has more parts than a scene ever needs. toml++ goes one call deeper with each: 20 000 parts end the
/// process. Found without parsing, as a row of words with dots between them, wherever it stands.
bool has_deep_key(const std::string& text) {
  int parts = 0;       // of the row so far
  char before = '\n';  // the last character that is no blank: '.', 'w' for a word, else another
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') i = end_of_quoted(text, i);
    if (c == ' ' || c == '\t') continue;
    const bool in_word = std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '"' || c == '\'';
    const bool goes_on = i > 0 && before == 'w' && text[i - 1] != ' ' && text[i - 1] != '\t';
    if (in_word && !goes_on) parts = before == '.' ? parts + 1 : 1;
    if (!in_word && !(c == '.' && before == 'w')) parts = 0;
    if (parts > deepest_key) return true;
    before = in_word ? 'w' : c;
  }
  return false;
}

constexpr const char* too_deep = "a key of more than 32 parts; expected one such as method.kind";

bool has_line_break(const std::string& text) { return text.find_first_of("\r\n") != std::string::npos; }

}  // namespace

std::string join_path(const std::string& path, const std::string& name) {
  return path.empty() ? name : path + "." + name;
}

Node parse_document(const std::string& text, const std::string& file) {
  Place place;
  place.file = file;
  if (has_deep_key(text)) fail(place, "", too_deep);
  try {
    Node root = convert(toml::parse(text, file), "", "", place);
    root.place.line = 0;
    return root;
  } catch (const toml::parse_error& error) {
    place.line = static_cast<int>(error.source().begin.line);
    fail(place, "", "not valid TOML: " + std::string{error.description()});
  }
}

Node parse_value(const std::string& text, const Node& spot, const Place& place) {
  if (has_deep_key(text)) fail(place, spot.path, too_deep);
  try {
    // A line break would let the text set other keys than its own.
    if (!has_line_break(text)) {
      const toml::table table = toml::parse("value = " + text);
      return convert(*table.get("value"), spot.name, spot.path, place);
    }
  } catch (const toml::parse_error&) {
    // No TOML value, so a bare word such as ddm.
  }
  Node node;
  node.kind = Node::Kind::string;
  node.name = spot.name;
  node.path = spot.path;
  node.place = place;
  node.text = text;
  return node;
}

std::vector<std::string> split_key(const std::string& key) {
  if (has_line_break(key) || key.find('=') != std::string::npos || has_deep_key(key)) return {};
  try {
    const toml::table document = toml::parse(key + " = 0");
    std::vector<std::string> parts;
    for (const toml::table* table = &document; table != nullptr;) {
      if (table->size() != 1) return {};  // a comment or a [header] rather than a key
      const auto entry = table->begin();
      parts.emplace_back(entry->first.str());
      table = entry->second.as_table();
    }
    return parts;
  } catch (const toml::parse_error&) {
    return {};
  }
}

}  // namespace mortise::scene_file
