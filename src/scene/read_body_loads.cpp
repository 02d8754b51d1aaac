// [[body_force]] and [[initial_strain]]
#include <array>
#include <cmath>

#include "scene/fail.hpp"
#include "scene/fields.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

const BodySpec& read_body_name(const Node& entry, const Node& root, const Scene& scene) {
  const Node& body = require(entry, "body", "the name of a body");
  std::vector<std::string> known;
  for (const BodySpec& spec : scene.bodies) {
    if (spec.name == name(body)) return spec;
    known.push_back(spec.name);
  }
  fail(blame(*find(root, "bodies"), body).place, body.path, unknown_name("body", body.text, known));
}

/// The strain alpha dT must be small, and alpha known. `entry` names the body.
Field read_temperature(const Node& entry, const BodySpec& body, const Node& root, const Scene& scene) {
  const Node& change = *find(entry, "temperature_change");
  // An override may have brought together a body and a material that do not go with the change.
  const Node& pairing = blame(*find(*find(root, "bodies"), body.name), *find(entry, "body"));
  const Node& material = *find(*find(root, "materials"), body.material);
  const Node* expansion = find(material, "thermal_expansion");
  if (expansion == nullptr) {
    fail(blame(pairing, change).place, change.path,
         "body '" + body.name + "' has the material '" + body.material + "' without thermal_expansion (" +
             locate(material) + "); expected one");
  }
  const std::string factor = " times the thermal_expansion " + describe(*expansion) + " (" + locate(*expansion) +
                             "); probably a unit mismatch";
  const double largest = 1 / std::abs(scene.materials.at(body.material).thermal_expansion);  // 1 / 0: any
  FieldUse use = expression_use(scene, false);
  use.limit = "a thermal strain below 1, which is this" + factor;
  if (std::isfinite(largest)) use.largest = largest;
  const Field field = scene_file::field(change, use);
  if (!field.is_constant() || std::abs(field.constant()) < largest) return field;
  fail(blame(pairing, blame(*expansion, change)).place, change.path,
       "expected a thermal strain below 1, found " + describe(change) + factor);
}

std::array<Field, 4> read_strain(const Node& node, const Scene& scene) {
  const std::array<const char*, 4> components{"xx", "yy", "zz", "xy"};
  expect_keys(node, {components.begin(), components.end()});
  if (node.items.empty()) fail(node, "is empty; expected at least one of xx, yy, zz, xy");
  std::array<Field, 4> strain;
  FieldUse use = expression_use(scene, false);
  use.largest = 1;
  use.limit = "a strain below 1";
  for (int i = 0; i < 4; ++i) {
    const Node* component = find(node, components[i]);
    if (component == nullptr) continue;
    strain[i] = field(*component, use);
    if (strain[i].is_constant() && std::abs(strain[i].constant()) >= 1)
      fail(*component, "expected a strain below 1, found " + describe(*component));
  }
  return strain;
}

}  // namespace

void read_body_forces(const Node& root, Scene& scene) {
  Once once;
  for (const Node* entry : entries(root, "body_force")) {
    expect_keys(*entry, {"body", "force"});
    const std::string& body = read_body_name(*entry, root, scene).name;
    once.take("body '" + body + "' is given a body force", *find(*entry, "body"), *entry);
    const Node& force = require(*entry, "force", "a force per volume [fx, fy]");
    scene.body_forces.push_back({locate(*entry), body, field_pair(force, expression_use(scene, false))});
  }
}

void read_initial_strains(const Node& root, Scene& scene) {
  Once once;
  for (const Node* entry : entries(root, "initial_strain")) {
    expect_keys(*entry, {"body", "temperature_change", "strain"});
    const BodySpec& body = read_body_name(*entry, root, scene);
    once.take("body '" + body.name + "' is given an initial strain", *find(*entry, "body"), *entry);
    InitialStrainSpec spec{locate(*entry), body.name, {}, {}};
    const Node& what = exactly_one(*entry, {"temperature_change", "strain"});
    if (what.name == "strain") {
      spec.strain = read_strain(what, scene);
    } else {
      spec.temperature_change = read_temperature(*entry, body, root, scene);
    }
    scene.initial_strains.push_back(spec);
  }
}

}  // namespace mortise::scene_file
