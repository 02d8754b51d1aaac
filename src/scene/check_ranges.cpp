#include "scene/check_ranges.hpp"

#include <limits>

#include "scene/sections.hpp"

namespace mortise {

void check_ranges(Scene scene, const Scene* checked) {
  using namespace scene_file;
  const auto changed = [&](auto... of) { return !checked || ((scene.*of != checked->*of) || ...); };
  if (changed(&Scene::mesh_file, &Scene::mesh_parameters, &Scene::geo_limits)) check(mesh_keys(scene), "mesh");
  if (changed(&Scene::model, &Scene::gravity)) check(model_keys(scene), "model");
  for (auto& [name, material] : scene.materials) {
    if (!material.stiffness) check(isotropic_keys(material), "materials." + name);
    check(material_keys(material), "materials." + name);
  }
  for (const auto contacts : {&Scene::contacts, &Scene::ties})
    for (ContactSpec& contact : scene.*contacts)
      if (changed(contacts)) check(contact_keys(contact, {}), contact.key);
  for (ProbeSpec& probe : scene.probes) check(probe_keys(probe), probe.key);
  for (Expectation& expectation : scene.expectations) check(expectation_keys(expectation, {}), expectation.key);
  if (changed(&Scene::method)) check(method_keys(scene.method), "method");
  if (scene.accuracy && changed(&Scene::accuracy))
    check(accuracy_keys(*scene.accuracy, std::numeric_limits<int>::max()), "accuracy");
}

}  // namespace mortise
