#include "problem/discretisation.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "fem/elements.hpp"

namespace mortise {
namespace {

int find_body(const Mesh& mesh, const std::string& key, const std::string& name) {
  const auto found = std::find(mesh.bodies.begin(), mesh.bodies.end(), name);
  if (found == mesh.bodies.end())
    throw SceneError(key + ": " + unknown_name("body", name, mesh.bodies) + " (" + mesh.source + ")");
  return int(found - mesh.bodies.begin());
}

// The material of each body of the mesh, and the initial strain upon it.
std::vector<ElasticLaw> laws_of(const Scene& scene, const Mesh& mesh) {
  std::vector<const Material*> materials(mesh.bodies.size(), nullptr);
  for (const BodySpec& body : scene.bodies)
    materials[find_body(mesh, "bodies." + body.name, body.name)] = &scene.materials.at(body.material);
  std::vector<Vec4> strains(mesh.bodies.size(), Vec4::Zero());
  for (const InitialStrainSpec& spec : scene.initial_strains) {
    const int b = find_body(mesh, spec.key, spec.body);
    strains[b] += spec.strain;
    if (spec.temperature_change && materials[b])
      strains[b].head<3>().array() += materials[b]->thermal_expansion * *spec.temperature_change;
  }
  std::vector<ElasticLaw> laws;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    if (!materials[b]) throw SceneError("bodies: body '" + mesh.bodies[b] + "' of " + mesh.source + " has no material");
    laws.push_back(elastic_law(materials[b]->young, materials[b]->poisson, scene.plane, strains[b]));
  }
  return laws;
}

void apply(const Mesh& mesh, const BoundarySpec& spec, Discretisation& d) {
  for (const std::string& name : spec.on) {
    const int boundary = scene_boundary(mesh, spec.key + ".on", name);
    if (spec.displacement_x) prescribe(mesh, boundary, 0, *spec.displacement_x, d.system.constraints);
    if (spec.displacement_y) prescribe(mesh, boundary, 1, *spec.displacement_y, d.system.constraints);
    if (spec.pressure)
      add_traction(
          mesh, boundary, [&](const Vec2&, const Vec2& n) -> Vec2 { return -*spec.pressure * n; }, d.system.f);
    if (spec.traction)
      add_traction(
          mesh, boundary, [&](const Vec2&, const Vec2&) -> Vec2 { return *spec.traction; }, d.system.f);
  }
}

Vec2 sum(const VecX& forces) { return forces.reshaped(2, forces.size() / 2).rowwise().sum(); }

double area(const Mesh& mesh, int body) {
  VecX load = VecX::Zero(2 * mesh.nodes.rows());
  add_body_force(mesh, body, Vec2(1, 0), load);  // int N, which sums to the area
  return load.sum();
}

}  // namespace

int scene_boundary(const Mesh& mesh, const std::string& key, const std::string& name) {
  const std::vector<std::string> names = boundary_names(mesh);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw SceneError(key + ": " + unknown_name("boundary", name, names) + " (" + mesh.source + ")");
  return int(found - names.begin());
}

Discretisation discretise(const Scene& scene, const Mesh& mesh) {
  check_cells(mesh);
  Discretisation d;
  d.system.stiffness_scale = 0;
  d.laws = laws_of(scene, mesh);
  d.system.constraints = no_constraints(mesh);
  d.initial_load = VecX::Zero(2 * mesh.nodes.rows());
  add_initial_strain(mesh, d.laws, d.initial_load);
  for (std::size_t b = 0; b < d.laws.size(); ++b)
    if (d.laws[b].energy0 != 0) d.initial_energy += d.laws[b].energy0 * area(mesh, int(b));
  d.system.f = d.initial_load;
  for (const BodyForceSpec& spec : scene.body_forces) {
    const Vec2 before = sum(d.system.f);
    add_body_force(mesh, find_body(mesh, spec.key, spec.body), spec.force, d.system.f);
    d.body_sums.push_back(sum(d.system.f) - before);
  }
  for (const BoundarySpec& spec : scene.boundaries) {
    const Vec2 before = sum(d.system.f);
    apply(mesh, spec, d);
    d.boundary_sums.push_back(sum(d.system.f) - before);
  }
  d.system.K = assemble_stiffness(mesh, d.laws);
  for (const ElasticLaw& law : d.laws) d.system.stiffness_scale = std::max(d.system.stiffness_scale, law.young);
  return d;
}

double strain_energy(const Discretisation& d, const VecX& u) {
  const VecX Ku = d.system.K.selfadjointView<Eigen::Lower>() * u;
  return 0.5 * u.dot(Ku) - u.dot(d.initial_load) + d.initial_energy;
}

}  // namespace mortise
