#include "scene/check_ranges.hpp"

#include <limits>

#include "scene/sections.hpp"

namespace mortise {

void check_ranges(Scene scene) {
  using namespace scene_file;
  check(mesh_keys(scene), "mesh");
  check(model_keys(scene), "model");
  for (auto& [name, material] : scene.materials) {
    if (!material.stiffness) check(isotropic_keys(material), "materials." + name);
    check(material_keys(material), "materials." + name);
  }
  for (auto* contacts : {&scene.contacts, &scene.ties})
    for (ContactSpec& contact : *contacts) check(contact_keys(contact, {}), contact.key);
  for (ProbeSpec& probe : scene.probes) check(probe_keys(probe), probe.key);
  for (Expectation& expectation : scene.expectations) check(expectation_keys(expectation, {}), expectation.key);
  check(method_keys(scene.method), "method");
  if (scene.accuracy) check(accuracy_keys(*scene.accuracy, std::numeric_limits<int>::max()), "accuracy");
}

}  // namespace mortise
