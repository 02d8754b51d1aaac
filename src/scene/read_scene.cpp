// A scene file from text to checked data.
#include <filesystem>

#include "model/mesh_endings.hpp"
#include "scene/fields.hpp"
#include "scene/files.hpp"
#include "scene/overrides.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

Node load_document(const std::string& path) {
  Place place;
  place.file = path;
  const std::string ending = std::filesystem::path{path}.extension().string();
  if (is_mesh_ending(ending)) {
    fail(place, "", "this is a geometry or a mesh; expected a scene file (.toml) that names it under [mesh]");
  }
  if (path.empty()) throw InputError("command line: the name of the scene is empty; expected a scene file (.toml)");
  const std::string trouble = file_trouble(path);
  if (!trouble.empty()) fail(place, "", trouble);
  return parse_document(read_text(path), path);
}

void read_title(const Node& root, Scene& scene) {
  if (const Node* title = find(root, "title")) scene.title = text(*title);
}

void read_model(const Node& root, Scene& scene) {
  const Node* model = find(root, "model");
  if (model == nullptr) return;
  expect_keys(*model, {"plane", "thickness", "gravity"});
  scene.model.plane =
      choice(find(*model, "plane"), {Plane::strain, Plane::stress, Plane::axisymmetric}, scene.model.plane);
  if (const Node* thickness = find(*model, "thickness")) {
    if (scene.model.axisymmetric())
      fail(*thickness, "an axisymmetric model has none; expected plane = \"strain\" or \"stress\" with it");
    scene.model.thickness = positive_number(*thickness);
  }
  if (const Node* gravity = find(*model, "gravity")) scene.gravity = number_pair(*gravity);
}

Scene read_sections(const Node& root, const std::string& path) {
  expect_keys(root, {"title", "mesh", "copies", "fields", "model", "materials", "bodies", "boundary", "body_force",
                     "initial_strain", "contact", "probe", "method", "accuracy"});
  Scene scene;
  scene.path = path;
  read_title(root, scene);
  read_mesh_section(root, scene);
  read_copies(root, scene);
  read_fields(root, scene);
  read_model(root, scene);
  read_bodies(root, scene);
  read_boundaries(root, scene);
  read_body_forces(root, scene);
  read_initial_strains(root, scene);
  read_contacts(root, scene);
  read_probes(root, scene);
  read_method(root, scene);
  read_accuracy(root, scene);
  return scene;
}

}  // namespace
}  // namespace mortise::scene_file

namespace mortise {

Scene read_scene(const std::string& path, const std::vector<Override>& overrides) {
  scene_file::Node root = scene_file::load_document(path);
  for (const Override& change : overrides) scene_file::apply_override(root, change);
  return scene_file::read_sections(root, path);
}

}  // namespace mortise
