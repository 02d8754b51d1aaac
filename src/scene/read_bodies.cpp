// [materials.NAME] and [bodies]
#include <algorithm>
#include <set>

#include "scene/fields.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

std::vector<std::string> material_names(const Scene& scene) {
  std::vector<std::string> list;
  for (const auto& [name, material] : scene.materials) list.push_back(name);
  return list;
}

BodySpec read_body(const Node& node, const Node& materials, const Scene& scene) {
  if (node.name.empty()) fail(node, "the name of the body is empty; expected a physical surface of the mesh");
  const std::string& material = name(node);
  if (!scene.materials.contains(material)) {
    fail(blame(materials, node).place, node.path, unknown_name("material", material, material_names(scene)));
  }
  return {node.name, material};
}

/// A material that no body has is a slip of the pen, unless a body was given another material on the command line.
void check_materials_are_used(const Node& materials, const Node& bodies, const Scene& scene) {
  const auto from_override = [](const Node& node) { return !node.place.setting.empty(); };
  const bool bodies_overridden = std::any_of(bodies.items.begin(), bodies.items.end(), from_override);
  std::set<std::string> used;
  for (const BodySpec& body : scene.bodies) used.insert(body.material);
  for (const Node& material : materials.items) {
    if (used.contains(material.name) || (bodies_overridden && !from_override(material))) continue;
    fail(material, "no body has the material '" + material.name + "'; expected it in [bodies]");
  }
}

}  // namespace

void read_bodies(const Node& root, Scene& scene) {
  const Node& materials = require(root, "materials", "at least one table [materials.NAME]");
  expect_table(materials);
  for (const Node& node : materials.items) {
    scene.materials[node.name] = read_material(node);
    if (!scene.gravity || find(node, "density") != nullptr) continue;
    const Node& gravity = *find(*find(root, "model"), "gravity");
    fail(blame(gravity, node), "'density' of the material '" + node.name +
                                   "' is missing; expected one, as there is gravity (" + locate(gravity) + ")");
  }
  const Node& bodies = require(root, "bodies", "a table [bodies] with entries surface = \"material\"");
  expect_table(bodies);
  for (const Node& node : bodies.items) scene.bodies.push_back(read_body(node, materials, scene));
  if (scene.bodies.empty()) fail(bodies, "is empty; expected at least one entry surface = \"material\"");
  check_materials_are_used(materials, bodies, scene);
}

}  // namespace mortise::scene_file
