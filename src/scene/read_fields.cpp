// [constants] and [fields]
#include <algorithm>
#include <cctype>

#include "scene/files.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

namespace fs = std::filesystem;

void require_free_name(const Node& node, const Scene& scene) {
  if (!is_free_name(node.name))
    fail(node,
         "'" + node.name + "' cannot be a name in expressions; expected letters, digits and _, and none of theirs");
  if (scene.constants.contains(node.name)) fail(node, "is one of [constants] too; expected another name");
}

FieldSpec read_field(const Node& node, const std::string& scene_path) {
  FieldSpec spec{locate(node), {}, node.name, {}, std::make_shared<NamedFunction>()};
  read(node, field_keys(spec));
  const Node& file = *find(node, "file");
  const fs::path path = resolve(file, scene_path);
  if (const std::string ending = path.extension().string(); ending != ".vtu" && ending != ".csv")
    fail(file, "expected a file that ends in .vtu or .csv, found '" + file.text + "'");
  require_file(file, path);
  spec.file = path.string();
  spec.function->name = node.name;
  const Node* component = find(node, "component");
  if (component != nullptr && path.extension() == ".csv")
    fail(*component, "is of the arrays of a .vtu; expected values = a column");
  return spec;
}

// Calls read(node) for each entry of a table whose names are to be free.
template <typename Read>
void for_each_new_name(const Node& root, const char* section, const Scene& scene, Read read) {
  const Node* table = find(root, section);
  if (table == nullptr) return;
  expect_table(*table);
  for (const Node& node : table->items) {
    require_free_name(node, scene);
    read(node);
  }
}

bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

void add_words(const std::string& text, std::set<std::string>& words) {
  for (auto start = std::ranges::find_if(text, in_word); start != text.end();) {
    const auto end = std::find_if_not(start, text.end(), in_word);
    words.emplace(start, end);
    start = std::find_if(end, text.end(), in_word);
  }
}

void add_words_of(const Node& node, std::set<std::string>& words) {
  if (node.kind == Node::Kind::string) add_words(node.text, words);
  for (const Node& item : node.items) add_words_of(item, words);
}

// `what`: "constant".
void require_each_used(const std::map<std::string, Node>& given, const char* what, const std::set<std::string>& words,
                       bool overridden) {
  std::vector<std::string> used;
  for (const auto& [name, node] : given)
    if (words.contains(name)) used.push_back(name);
  for (const auto& [name, node] : given) {
    if (words.contains(name) || (overridden && node.place.setting.empty())) continue;
    const std::string meant = nearest_name(name, used);
    fail(node, std::string("no expression has the ") + what + " '" + name + "'; " +
                   (meant.empty() ? "expected it in one" : "did you mean '" + meant + "'?"));
  }
}

}  // namespace

void GivenNames::take(const Node& root) {
  for (const Node& section : root.items) {
    if (section.name == "constants" || section.name == "fields")
      for (const Node& node : section.items) (section.name == "fields" ? fields : constants).emplace(node.name, node);
    else if (section.name != "title")
      add_words_of(section, words);
  }
}

void GivenNames::require_used(bool overridden) const {
  require_each_used(constants, "constant", words, overridden);
  require_each_used(fields, "field", words, overridden);
}

Keys field_keys(FieldSpec& spec) {
  return {
      required({"file",
                {{"type", "string"}, {"pattern", "\\.(vtu|csv)$"}},
                "a `.vtu` or a `.csv`, relative to the scene file"},
               "the name of a .vtu or a .csv"),
      key("values", spec.values, a_name(), "the array or the column that has the values", "the field's own name"),
      key("component", spec.component, whole_number(0, 8),
          "of an array of a `.vtu` with several components, counted from 0"),
  };
}

void read_fields(const Node& root, Scene& scene) {
  for_each_new_name(root, "fields", scene,
                    [&](const Node& node) { scene.fields.push_back(read_field(node, scene.path)); });
}

void read_constants(const Node& root, Scene& scene) {
  for_each_new_name(root, "constants", scene, [&](const Node& node) { scene.constants[node.name] = number(node); });
}

}  // namespace mortise::scene_file
