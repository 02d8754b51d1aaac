#include "scene/loads.hpp"

#include <algorithm>

#include "base/overloaded.hpp"

namespace mortise {
namespace {

template <typename Change>
void change_given(auto& value, const Change& change) {
  if (value) change(*value);
}

// Of a rigid curve what is prescribed stays so.
template <typename Change>
void change_values(BoundaryCondition& what, const Change& change) {
  std::visit(
      Overloaded{[&](Displacement& u) {
                   change_given(u.x, change);
                   change_given(u.y, change);
                 },
                 [&](NormalDisplacement& u) { change(u.value); }, [&](DirectedDisplacement& u) { change(u.value); },
                 [&](RigidSpec& rigid) {
                   for (auto* motion : {&rigid.x, &rigid.y, &rigid.rotation}) change_given(*motion, change);
                   change(rigid.force);
                   change(rigid.moment);
                 },
                 [&](Pressure& p) { change(p.value); }, [&](SurfaceTraction& t) { change(t.value); },
                 [&](TotalForce& force) { change(force.value); }, [](NormalFoundation&) {}, [](AxesFoundation&) {},
                 [](PointSpring&) {}},
      what);
}

// Calls change(value) for a Field, VectorField, double or Vec2 that acts on the bodies.
template <typename Change>
void change_loads(Scene& scene, const Change& change) {
  change_given(scene.gravity, change);
  for (BoundarySpec& boundary : scene.boundaries) change_values(boundary.what, change);
  for (BodyForceSpec& force : scene.body_forces) change(force.force);
  for (InitialStrainSpec& strain : scene.initial_strains) {
    change_given(strain.temperature_change, change);
    for (Field& component : strain.strain) change(component);
  }
  for (ContactSpec& contact : scene.contacts)
    if (contact.fluid) change(contact.fluid->pressure);
}

// Keys of entries with loads go, too: they say where the values were given.
Scene without_loads(Scene scene) {
  change_loads(scene, Overloaded{[](Field& f) { f = Field(); }, [](VectorField& f) { f = VectorField(); },
                                 [](double& value) { value = 0; }, [](Vec2& v) { v.setZero(); }});
  scene.gravity.reset();
  for (auto& [name, material] : scene.materials) material.thermal_expansion = material.density = 0;
  for (BoundarySpec& boundary : scene.boundaries) boundary.key.clear();
  for (BodyForceSpec& force : scene.body_forces) force.key.clear();
  for (InitialStrainSpec& strain : scene.initial_strains) strain.key.clear();
  // What is locked are the overlaps that pretension makes in these gaps.
  if (std::ranges::none_of(scene.ties, &ContactSpec::locked)) {
    for (ContactSpec& contact : scene.contacts) contact.gap = contact.clearance = Field();
    for (ContactSpec& tie : scene.ties)
      for (auto* given : {&tie.pretension, &tie.overlap})
        if (*given) *given = 0;
  }
  scene.expectations.clear();
  return scene;
}

}  // namespace

bool differ_in_loads_alone(const Scene& one, const Scene& other) {
  const Scene a = without_loads(one), b = without_loads(other);
  return a.path == b.path && a.title == b.title && a.mesh_file == b.mesh_file &&
         a.mesh_parameters == b.mesh_parameters && a.geo_limits == b.geo_limits && a.copies == b.copies &&
         a.fields == b.fields && a.model == b.model && a.materials == b.materials && a.bodies == b.bodies &&
         a.boundaries == b.boundaries && a.body_forces == b.body_forces && a.initial_strains == b.initial_strains &&
         a.contacts == b.contacts && a.ties == b.ties && a.probes == b.probes && a.method == b.method &&
         a.accuracy == b.accuracy;
}

Scene scaled_loads(Scene scene, double factor) {
  const auto scale = [&](Field& f) { f = f.times(factor); };
  change_loads(scene, Overloaded{scale,
                                 [&](VectorField& f) {
                                   scale(f.x);
                                   scale(f.y);
                                 },
                                 [&](double& value) { value *= factor; }, [&](Vec2& v) { v *= factor; }});
  return scene;
}

}  // namespace mortise
