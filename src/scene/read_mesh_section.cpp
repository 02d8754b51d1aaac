// [mesh]
#include <filesystem>

#include "model/mesh_endings.hpp"
#include "scene/fields.hpp"
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
  const std::string trouble = file_trouble(path);
  if (!trouble.empty()) fail(file, "'" + path.string() + "': " + trouble);
}

void read_limits(const Node& mesh, Scene& scene) {
  if (const Node* limit = find(mesh, "time_limit")) scene.geo_limits.seconds = positive_number(*limit);
  if (const Node* programs = find(mesh, "programs")) scene.geo_limits.programs = boolean(*programs);
}

}  // namespace

void read_mesh_section(const Node& root, Scene& scene) {
  const Node& mesh = require(root, "mesh", "a table [mesh] with file = \"NAME.geo\" or \"NAME.msh\"");
  expect_keys(mesh, {"file", "parameters", "time_limit", "programs"});
  read_limits(mesh, scene);
  const Node& file = require(mesh, "file", "the name of a .geo, a .msh or another mesh file");
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
