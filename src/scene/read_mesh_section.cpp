// [mesh]
#include <filesystem>

#include "model/mesh_endings.hpp"
#include "scene/files.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

namespace fs = std::filesystem;

void check_mesh_file(const Node& file, const fs::path& path) {
  if (!is_mesh_ending(path.extension().string())) {
    fail(file, std::string("expected a file that ends in ") + mesh_endings_in_words + ", found '" + file.text + "'" +
                   mesh_ending_advice(file.text));
  }
  require_file(file, path);
}

}  // namespace

Keys mesh_keys(Scene& scene) {
  std::string endings;
  for (const std::string_view ending : mesh_endings)
    endings += (endings.empty() ? "" : "|") + std::string(ending.substr(1));
  return {
      required(
          {"file",
           {{"type", "string"}, {"pattern", "\\.(" + endings + ")$"}},
           "a `.geo`, which is meshed, a `.msh` (2.2 or 4.1), a `.inp` of Abaqus or CalculiX, a universal file `.unv`, "
           "or bulk data of Nastran, `.bdf` or `.nas` ([below](#decks-of-other-programs)); relative to the scene file"},
          "the name of a .geo, a .msh or another mesh file"),
      {"parameters",
       {{"type", "object"}, {"additionalProperties", a_number().schema}},
       "table of numbers for the names that the `.geo` lists in `DefineConstant`, within the `Min`, `Max` and "
       "`Choices` that it gives there as plain numbers",
       "the `.geo`'s own"},
      key("time_limit", scene.geo_limits.seconds, above(0),
          "> 0, seconds that gmsh may take for a `.geo`; then the run ends with exit status 1"),
      key("programs", scene.geo_limits.programs, true_or_false(),
          "`false`: a `.geo` that runs programs or writes files is refused, as with `--no-programs`"),
  };
}

void read_mesh_section(const Node& root, Scene& scene) {
  const Node& mesh = require(root, "mesh", "a table [mesh] with file = \"NAME.geo\" or \"NAME.msh\"");
  read(mesh, mesh_keys(scene));
  const Node& file = *find(mesh, "file");
  const fs::path path = resolve(file, scene.path);
  check_mesh_file(file, path);
  scene.mesh_file = path.string();
  const Node* parameters = find(mesh, "parameters");
  if (parameters == nullptr) return;
  expect_table(*parameters);
  for (const Node& parameter : parameters->items) {
    if (path.extension() != ".geo") {
      fail(blame(file, parameter).place, parameter.path,
           "a mesh file is meshed already and takes no parameters; expected a .geo, found '" + file.text + "'");
    }
    scene.mesh_parameters[parameter.name] = number(parameter);
  }
}

}  // namespace mortise::scene_file
