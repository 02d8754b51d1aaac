// A scene file from text to checked data.
#include <algorithm>
#include <array>
#include <filesystem>

#include "model/mesh_endings.hpp"
#include "scene/files.hpp"
#include "scene/overrides.hpp"
#include "scene/schema.hpp"
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

void read_model(const Node& root, Scene& scene) {
  const Node* model = find(root, "model");
  if (model == nullptr) return;
  read(*model, model_keys(scene));
  if (const Node* thickness = find(*model, "thickness"); thickness && scene.model.axisymmetric())
    fail(*thickness, "an axisymmetric model has none; expected plane = \"strain\" or \"stress\" with it");
}

// Of an override, or something in it.
bool may_have_an_expression(const Override& change) {
  return std::ranges::any_of(std::array{"boundary", "body_force", "initial_strain", "contact", "expect", "case"},
                             [&](const char* section) { return change.key.starts_with(section); });
}

Scene read_sections(const Node& root, const std::string& path, GivenNames& names) {
  std::vector<std::string> known;
  for (const Section& section : sections()) known.push_back(section.name);
  expect_keys(root, known);
  Scene scene;
  scene.path = path;
  names.take(root);
  if (const Node* title = find(root, "title")) scene.title = text(*title);
  read_mesh_section(root, scene);
  read_copies(root, scene);
  read_constants(root, scene);
  read_fields(root, scene);
  read_model(root, scene);
  read_bodies(root, scene);
  read_boundaries(root, scene);
  read_body_forces(root, scene);
  read_initial_strains(root, scene);
  read_contacts(root, scene);
  read_probes(root, scene);
  read_expectations(root, scene);
  read_method(root, scene);
  read_accuracy(root, scene);
  read_cases(
      root, [&](const Node& changed) { return read_sections(changed, path, names); }, scene);
  return scene;
}

}  // namespace

Keys model_keys(Scene& scene) {
  return {
      key("plane", scene.model.plane, any_of<Plane>(),
          "`\"strain\"`, `\"stress\"`, or `\"axisymmetric\"`: x is the radius, y along the axis x = 0, whose nodes are "
          "held; forces and energy are those of the whole ring"),
      key("thickness", scene.model.thickness, above(0),
          "> 0, of a plane model: forces, moments, energy, springs and reactions are those of it; pressures and "
          "displacements do not depend on it"),
      key("gravity", scene.gravity, a_pair(), "`[gx, gy]`: a force per volume of `density` times this on every body"),
  };
}

}  // namespace mortise::scene_file

namespace mortise {

Scene read_scene(const std::string& path, const std::vector<Override>& overrides) {
  scene_file::Node root = scene_file::load_document(path);
  scene_file::GivenNames names;
  for (const Override& change : overrides) scene_file::apply_override(root, change);
  Scene scene = scene_file::read_sections(root, path, names);
  names.require_used(std::ranges::any_of(overrides, scene_file::may_have_an_expression));
  for (const Override& change : overrides) scene.changes.push_back(change.key + "=" + change.value);
  for (LoadCase& load : scene.cases) {
    load.scene.changes = scene.changes;
    load.scene.load_case = load.name;
  }
  return scene;
}

}  // namespace mortise
