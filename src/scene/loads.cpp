#include "scene/loads.hpp"

#include "base/overloaded.hpp"

namespace mortise {
namespace {

void take_values_away(std::optional<Field>& field) {
  if (field) field = Field();
}

void take_values_away(std::optional<double>& value) {
  if (value) value = 0;
}

// Of a rigid curve what is prescribed stays so.
void take_values_away(RigidSpec& rigid) {
  take_values_away(rigid.x);
  take_values_away(rigid.y);
  take_values_away(rigid.rotation);
  rigid.force.setZero();
  rigid.moment = 0;
}

void take_values_away(BoundaryCondition& what) {
  std::visit(
      Overloaded{[](Displacement& u) {
                   take_values_away(u.x);
                   take_values_away(u.y);
                 },
                 [](NormalDisplacement& u) { u.value = Field(); }, [](DirectedDisplacement& u) { u.value = Field(); },
                 [](RigidSpec& rigid) { take_values_away(rigid); }, [](Pressure& p) { p.value = Field(); },
                 [](SurfaceTraction& t) { t.value = VectorField(); }, [](TotalForce& force) { force.value.setZero(); },
                 [](NormalFoundation&) {}, [](AxesFoundation&) {}, [](PointSpring&) {}},
      what);
}

// Keys of entries with loads go, too: they say where the values were given.
Scene without_loads(Scene scene) {
  scene.gravity.reset();
  for (auto& [name, material] : scene.materials) material.thermal_expansion = material.density = 0;
  for (BoundarySpec& boundary : scene.boundaries) {
    boundary.key.clear();
    take_values_away(boundary.what);
  }
  for (BodyForceSpec& force : scene.body_forces) {
    force.key.clear();
    force.force = VectorField();
  }
  for (InitialStrainSpec& strain : scene.initial_strains) {
    strain.key.clear();
    take_values_away(strain.temperature_change);
    strain.strain.fill(Field());
  }
  for (ContactSpec& contact : scene.contacts) contact.gap = contact.clearance = Field();
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

}  // namespace mortise
