// [[body_force]] and [[initial_strain]]
#include <algorithm>
#include <array>
#include <cmath>

#include "model/patterns.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

/// The entries of [bodies] that may hold a body that an entry of a section names: its own alone, if there is one; of a
/// pattern none that has an entry of its own there. Throws if there can be none.
std::vector<const BodySpec*> bodies_named(const Node& entry, const std::vector<const Node*>& section, const Node& root,
                                          const Scene& scene) {
  const std::string& body = find(entry, "body")->text;
  const auto has_its_own = [&](const BodySpec& spec) {
    return is_pattern(body) && std::ranges::any_of(section, [&](const Node* other) {
             const Node* named = find(*other, "body");
             return named != nullptr && named->text == spec.name && spec.name != body;
           });
  };
  std::vector<const BodySpec*> found;
  std::vector<std::string> known;
  for (const BodySpec& spec : scene.bodies) {
    if (spec.name == body && !is_pattern(body)) return {&spec};
    if (share_a_name(spec.name, body) && !has_its_own(spec)) found.push_back(&spec);
    known.push_back(spec.name);
  }
  const Node& node = *find(entry, "body");
  if (found.empty()) fail(blame(*find(root, "bodies"), node).place, node.path, unknown_name("body", body, known));
  return found;
}

/// The strain alpha dT must be small, and alpha known, in each body that the entry may name.
Field read_temperature(const Node& entry, const std::vector<const BodySpec*>& bodies, const Node& root,
                       const Scene& scene) {
  const Node& change = *find(entry, "temperature_change");
  FieldUse use = expression_use(scene, false);
  for (const BodySpec* body : bodies) {
    // An override may have brought together a body and a material that do not go with the change.
    const Node& pairing = blame(*find(*find(root, "bodies"), body->name), *find(entry, "body"));
    const Node& material = *find(*find(root, "materials"), body->material);
    const Node* expansion = find(material, "thermal_expansion");
    if (expansion == nullptr) {
      fail(blame(pairing, change).place, change.path,
           "body '" + body->name + "' has the material '" + body->material + "' without thermal_expansion (" +
               locate(material) + "); expected one");
    }
    const double largest = 1 / std::abs(scene.materials.at(body->material).thermal_expansion);  // 1 / 0: any
    const std::string factor = " times the thermal_expansion " + describe(*expansion) + " (" + locate(*expansion) +
                               "); probably a unit mismatch";
    if (change.kind == Node::Kind::number && std::isfinite(change.number) && std::abs(change.number) >= largest)
      fail(blame(pairing, blame(*expansion, change)).place, change.path,
           "expected a thermal strain below 1, found " + describe(change) + factor);
    if (largest >= use.largest) continue;
    use.largest = largest;
    use.limit = "a thermal strain below 1, which is this" + factor;
  }
  return field(change, use);
}

constexpr std::array<const char*, 4> strain_components{"xx", "yy", "zz", "xy"};

Keys strain_keys() {
  Keys keys;
  for (const char* component : strain_components) keys.push_back({component, a_field({}).schema, ""});
  return keys;
}

std::array<Field, 4> read_strain(const Node& node, const Scene& scene) {
  expect_keys(node, strain_keys());
  if (node.items.empty()) fail(node, "is empty; expected at least one of xx, yy, zz, xy");
  std::array<Field, 4> strain;
  FieldUse use = expression_use(scene, false);
  use.largest = 1;
  use.limit = "a strain below 1";
  for (int i = 0; i < 4; ++i) {
    const Node* component = find(node, strain_components[i]);
    if (component == nullptr) continue;
    strain[i] = field(*component, use);
    if (strain[i].is_constant() && std::abs(strain[i].constant()) >= 1)
      fail(*component, "expected a strain below 1, found " + describe(*component));
  }
  return strain;
}

}  // namespace

Keys body_force_keys(BodyForceSpec& spec, const FieldUse& use) {
  return {
      required(key("body", spec.body, a_name(), "a body, or a pattern of bodies"), "the name of a body"),
      required(key("force", spec.force, two_fields(use), "`[fx, fy]` per volume, functions of place"),
               "a force per volume [fx, fy]"),
  };
}

Keys initial_strain_keys(InitialStrainSpec& spec) {
  Json strain = object_of(strain_keys());
  strain["minProperties"] = 1;
  return {
      required(key("body", spec.body, a_name(), "a body, or a pattern of bodies"), "the name of a body"),
      {"temperature_change", a_field({}).schema, "a function of place: the strain is that times `thermal_expansion`",
       "this, or `strain`"},
      {"strain", strain, "`{ xx, yy, zz, xy }`, `xy` the tensor component; functions of place",
       "this, or `temperature_change`"},
  };
}

void read_body_forces(const Node& root, Scene& scene) {
  Once once;
  const std::vector<const Node*> section = entries(root, "body_force");
  for (const Node* entry : section) {
    BodyForceSpec spec;
    read(*entry, body_force_keys(spec, expression_use(scene, false)));
    spec.key = locate(*entry);
    bodies_named(*entry, section, root, scene);
    once.take("body '" + spec.body + "' is given a body force", *find(*entry, "body"), *entry);
    scene.body_forces.push_back(spec);
  }
}

void read_initial_strains(const Node& root, Scene& scene) {
  Once once;
  const std::vector<const Node*> section = entries(root, "initial_strain");
  for (const Node* entry : section) {
    InitialStrainSpec spec;
    read(*entry, initial_strain_keys(spec));
    spec.key = locate(*entry);
    const std::vector<const BodySpec*> bodies = bodies_named(*entry, section, root, scene);
    once.take("body '" + spec.body + "' is given an initial strain", *find(*entry, "body"), *entry);
    const Node& what = exactly_one(*entry, {"temperature_change", "strain"});
    if (what.name == "strain") {
      spec.strain = read_strain(what, scene);
    } else {
      spec.temperature_change = read_temperature(*entry, bodies, root, scene);
    }
    scene.initial_strains.push_back(spec);
  }
}

}  // namespace mortise::scene_file
