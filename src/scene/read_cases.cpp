// [[case]] and [cases]
#include <algorithm>
#include <fstream>
#include <set>

#include "base/csv_fields.hpp"
#include "scene/files.hpp"
#include "scene/loads.hpp"
#include "scene/overrides.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

// Of one scene: each is kept in memory, some 20 kB.
constexpr std::size_t most_cases = 10000;
constexpr std::size_t longest_name = 100;

// A case before its scene is read.
struct Draft {
  std::string name;
  Place place;
  std::string path;  // of the entry
  double scale = 1;
  std::vector<Change> changes = {};
};

std::string joined(const std::vector<std::string>& parts) {
  std::string key;
  for (const std::string& part : parts) key = join_path(key, part);
  return key;
}

std::string words(const Node& value) { return value.kind == Node::Kind::string ? value.text : describe(value); }

// The value, at its new place.
Node moved(Node value, const std::string& name, const std::string& path) {
  value.name = name;
  value.path = path;
  for (Node& item : value.items) item = moved(item, item.name, join_path(path, item.name));
  return value;
}

// Each value that a key leads to, those of a table one by one.
void add_changes(const Node& value, const std::vector<std::string>& parts, Draft& draft) {
  if (value.kind != Node::Kind::table) {
    draft.changes.push_back(
        {parts, value.place, [value](const Node& spot) { return moved(value, spot.name, spot.path); }});
    return;
  }
  for (const Node& item : value.items) {
    std::vector<std::string> longer = parts;
    longer.push_back(item.name);
    add_changes(item, longer, draft);
  }
}

// The parts of a key that may be quoted as a whole: "boundary.2.pressure".
std::vector<std::string> parts_of(const std::string& key) {
  std::vector<std::string> parts = split_key(key);
  return parts.empty() ? std::vector{key} : parts;
}

void refuse_cases_in_cases(const std::vector<std::string>& parts, const Place& place, const std::string& path) {
  if (parts[0] == "case" || parts[0] == "cases")
    fail(place, path, "a case has no cases; expected another key of the scene, such as boundary.2.pressure");
}

std::vector<std::pair<std::string, double>> scales_of(const Node& entry) {
  const Node* scale = find(entry, "scale");
  std::vector<std::pair<std::string, double>> scales;
  if (scale == nullptr) return scales;
  if (scale->kind != Node::Kind::list) return {{scale->text, number(*scale)}};
  if (scale->items.empty()) fail_expected(*scale, "a number or a list of numbers");
  for (const Node& item : scale->items) scales.emplace_back(item.text, number(item));
  return scales;
}

// One case, or one a scale.
void add_entry(const Node& entry, const CaseEntry& of, std::vector<Draft>& drafts) {
  Draft draft{of.name, entry.place, entry.path};
  for (const Node& node : entry.items) {
    if (node.name == "name" || node.name == "scale") continue;
    const std::vector<std::string> parts = parts_of(node.name);
    refuse_cases_in_cases(parts, node.place, node.path);
    add_changes(node, parts, draft);
  }
  const Node* scale = find(entry, "scale");
  const bool several = scale != nullptr && scale->kind == Node::Kind::list;
  for (const auto& [text, value] : scales_of(entry)) {
    draft.name = several           ? (of.name.empty() ? "scale" : of.name) + "_" + text
                 : of.name.empty() ? "scale_" + text
                                   : of.name;
    draft.scale = value;
    drafts.push_back(draft);
  }
  if (scale == nullptr) drafts.push_back(draft);
}

// A row a case: its name, its scale, and values of keys; empty fields change nothing.
void add_table(const Node& file, const std::string& scene_path, std::vector<Draft>& drafts) {
  const std::filesystem::path path = resolve(file, scene_path);
  require_file(file, path);
  Place place{.file = path.string(), .line = 1, .column = 0, .setting = {}};
  std::ifstream stream(path, std::ios::binary);
  std::string header, line;
  std::getline(stream, header);
  const char separator = csv_separator(header);
  const auto names = csv_fields(header, separator);
  std::vector<std::vector<std::string>> keys;
  for (const auto name : names) {
    if (name.empty()) fail(place, "", "a column without a name; expected name, scale or a key of the scene");
    if (std::ranges::count(names, name) > 1)
      fail(place, "", "two columns '" + std::string(name) + "'; expected one a key");
    keys.push_back(parts_of(std::string(name)));
    refuse_cases_in_cases(keys.back(), place, std::string(name));
  }
  const std::size_t before = drafts.size();
  while (std::getline(stream, line)) {
    ++place.line;
    if (is_blank_line(line)) continue;
    const auto fields = csv_fields(line, separator);
    if (fields.size() != names.size())
      fail(place, "",
           std::to_string(fields.size()) + " fields; expected " + std::to_string(names.size()) +
               ", as the first line has");
    Draft draft{"", place, ""};
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string text(fields[k]);
      if (text.empty()) continue;
      if (names[k] == "name") {
        draft.name = text;
      } else if (names[k] == "scale") {
        Node spot;
        spot.path = "scale";
        draft.scale = number(parse_value(text, spot, place));
      } else {
        draft.changes.push_back(
            {keys[k], place, [text, place](const Node& spot) { return parse_value(text, spot, place); }});
      }
    }
    drafts.push_back(draft);
  }
  if (drafts.size() == before) fail(file, "'" + path.string() + "' has no rows; expected one a case, below the names");
}

std::vector<Draft> drafts_of(const std::vector<const Node*>& given, const std::string& scene_path) {
  std::vector<Draft> drafts;
  for (const Node* entry : given) {
    CaseEntry of;
    for (const Key& key : case_keys(of))
      if (const Node* node = find(*entry, key.name); node && key.read) key.read(*node);
    const Node* file = find(*entry, "file");
    if (file != nullptr && entry->items.size() > 1)
      fail(*file, "goes with no other key; expected those of its cases as columns of the table");
    if (file != nullptr)
      add_table(*file, scene_path, drafts);
    else
      add_entry(*entry, of, drafts);
    if (drafts.size() > most_cases)
      fail(*entry, "more than " + std::to_string(most_cases) + " cases; expected fewer, or several scenes");
  }
  return drafts;
}

// Names may be folders' and stand in a table.
void check_name(const Draft& draft, std::set<std::string>& taken) {
  const std::string path = draft.path.empty() ? "name" : draft.path + ".name";
  const bool fits = std::ranges::all_of(draft.name, [](unsigned char c) {
    return (c < 128 && std::isalnum(c)) || (c != 0 && std::string("_-+.").find(char(c)) != std::string::npos);
  });
  if (!fits || draft.name[0] == '.' || draft.name.size() > longest_name)
    fail(draft.place, path,
         "'" + draft.name.substr(0, longest_name) + "': expected letters, digits and _ - + . (not first), at most " +
             std::to_string(longest_name) + ": the case may have a folder of this name");
  if (!taken.insert(draft.name).second)
    fail(draft.place, path, "'" + draft.name + "' is the name of a case before it; expected one of its own");
}

}  // namespace

Keys cases_keys(Scene& scene) {
  return {
      key("write", scene.case_files, any_of<CaseFiles>(),
          "what is written of cases: `\"table\"`, cases.csv; `\"contact\"`, also a folder `cases/NAME` of each, with "
          "its "
          "summary.json and what runs along the contact lines; `\"all\"`, the whole results of each there, and "
          "cases.pvd"),
  };
}

Keys case_keys(CaseEntry& entry) {
  return {
      key("name", entry.name, a_name(),
          "of the case: letters, digits and `_ - + .`; with a list of scales `NAME_SCALE`",
          "`scale_SCALE`, or the number of the case from 0"),
      {"scale", either(a_number().schema, list_of(a_number().schema, 1)),
       "a factor of all loads: forces, pressures, tractions, prescribed displacements, gravity, body forces, "
       "temperatures and initial strains; gaps and clearances stay. A list gives so many cases",
       "1"},
      key("file", entry.file, a_name(),
          "a `.csv` with a row a case, relative to the scene file: columns `name`, `scale` and keys of the scene, "
          "whose "
          "empty fields change nothing; in place of the other keys"),
  };
}

void read_cases(const Node& root, const std::function<Scene(const Node&)>& read_scene, Scene& scene) {
  if (const Node* cases = find(root, "cases")) read(*cases, cases_keys(scene));
  const std::vector<const Node*> given = entries(root, "case");
  if (given.empty()) return;
  Node plain = root;
  std::erase_if(plain.items, [](const Node& node) { return node.name == "case" || node.name == "cases"; });
  std::optional<Scene> unchanged;  // that cases which are scaled alone have
  std::set<std::string> taken;
  for (Draft& draft : drafts_of(given, scene.path)) {
    if (draft.name.empty()) draft.name = std::to_string(scene.cases.size());
    check_name(draft, taken);
    LoadCase& load = scene.cases.emplace_back();
    load.name = draft.name;
    load.scale = draft.scale;
    if (draft.changes.empty()) {
      if (!unchanged) unchanged = read_scene(plain);
      load.scene = scaled_loads(*unchanged, draft.scale);
      continue;
    }
    Node changed = plain;
    for (const Change& change : draft.changes) {
      apply(changed, change);
      load.changed.emplace_back(joined(change.parts), words(change.value({})));
    }
    load.scene = scaled_loads(read_scene(changed), draft.scale);
  }
}

}  // namespace mortise::scene_file
