// [fields]
#include "scene/fields.hpp"
#include "scene/files.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

namespace fs = std::filesystem;

FieldSpec read_field(const Node& node, const std::string& scene_path) {
  if (!is_free_name(node.name)) {
    fail(node,
         "'" + node.name + "' cannot be a name in expressions; expected letters, digits and _, and none of theirs");
  }
  expect_keys(node, {"file", "values", "component"});
  const Node& file = require(node, "file", "the name of a .vtu or a .csv");
  const fs::path path = resolve(file, scene_path);
  if (const std::string ending = path.extension().string(); ending != ".vtu" && ending != ".csv")
    fail(file, "expected a file that ends in .vtu or .csv, found '" + file.text + "'");
  if (const std::string trouble = file_trouble(path); !trouble.empty())
    fail(file, "'" + path.string() + "': " + trouble);
  FieldSpec spec{locate(node), path.string(), node.name, {}, std::make_shared<NamedFunction>()};
  spec.function->name = node.name;
  if (const Node* values = find(node, "values")) spec.values = name(*values);
  const Node* component = find(node, "component");
  if (component != nullptr && path.extension() == ".csv")
    fail(*component, "is of the arrays of a .vtu; expected values = a column");
  if (component != nullptr) spec.component = whole(*component, 0, 8);
  return spec;
}

}  // namespace

void read_fields(const Node& root, Scene& scene) {
  const Node* fields = find(root, "fields");
  if (fields == nullptr) return;
  expect_table(*fields);
  for (const Node& node : fields->items) scene.fields.push_back(read_field(node, scene.path));
}

}  // namespace mortise::scene_file
