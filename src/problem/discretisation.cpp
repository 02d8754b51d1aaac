#include "problem/discretisation.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "base/patterns.hpp"
#include "fem/elements.hpp"
#include "mesh/side_table.hpp"
#include "problem/boundary_conditions.hpp"

namespace mortise {
namespace {

// Of each body; nullptr: none. A name of its own counts before a pattern.
std::vector<const Material*> materials_of(const Scene& scene, const Mesh& mesh, const SceneNames& names) {
  std::vector<const BodySpec*> given(mesh.bodies.size(), nullptr);
  for (const BodySpec& spec : scene.bodies)
    for (const int b : names.bodies("bodies." + spec.name, spec.name)) {
      const BodySpec* other = given[b];
      if (other && is_pattern(other->name) && is_pattern(spec.name) && other->material != spec.material)
        throw SceneError("bodies: body '" + mesh.bodies[b] + "' is a '" + other->name + "' of '" + other->material +
                         "' and a '" + spec.name + "' of '" + spec.material + "'; expected one material");
      if (!other || is_pattern(other->name)) given[b] = &spec;
    }
  std::vector<const Material*> materials;
  for (const BodySpec* spec : given) materials.push_back(spec ? &scene.materials.at(spec->material) : nullptr);
  return materials;
}

// The material of each body of the mesh, and the initial strain upon it.
std::vector<ElasticLaw> laws_of(const Scene& scene, const Mesh& mesh, const SceneNames& names,
                                const std::vector<const Material*>& materials) {
  std::vector<Vec4> strains(mesh.bodies.size(), Vec4::Zero());
  for (const InitialStrainSpec& spec : scene.initial_strains) {
    for (const int b : names.bodies(spec.key, spec.body)) {
      strains[b] += spec.strain;
      if (spec.temperature_change && materials[b])
        strains[b].head<3>().array() += materials[b]->thermal_expansion * *spec.temperature_change;
    }
  }
  std::vector<ElasticLaw> laws;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    if (!materials[b]) throw SceneError("bodies: body '" + mesh.bodies[b] + "' of " + mesh.source + " has no material");
    laws.push_back(elastic_law(materials[b]->young, materials[b]->poisson, scene.plane, strains[b]));
  }
  return laws;
}

}  // namespace

Discretisation discretise(const Scene& scene, const Mesh& mesh) {
  check_cells(mesh);
  Discretisation d;
  d.system.stiffness_scale = 0;
  const SceneNames names(mesh);
  const std::vector<const Material*> materials = materials_of(scene, mesh, names);
  d.laws = laws_of(scene, mesh, names, materials);
  d.system.constraints = no_constraints(mesh);
  d.initial_load = VecX::Zero(2 * mesh.nodes.rows());
  add_initial_strain(mesh, d.laws, d.initial_load);
  const VecX areas = body_areas(mesh);
  for (std::size_t b = 0; b < d.laws.size(); ++b) d.initial_energy += d.laws[b].energy0 * areas(b);
  d.system.f = d.initial_load;
  std::vector<Vec2> forces(mesh.bodies.size(), Vec2::Zero());
  for (const BodyForceSpec& spec : scene.body_forces) {
    Vec2& sum = d.body_sums.emplace_back(Vec2::Zero());
    for (const int body : names.bodies(spec.key, spec.body)) {
      forces[body] += spec.force;
      sum += spec.force * areas(body);
    }
  }
  for (std::size_t b = 0; scene.gravity && b < forces.size(); ++b) {
    const Vec2 weight = materials[b]->density * *scene.gravity;
    forces[b] += weight;
    d.weight += weight * areas(b);
  }
  if (!scene.body_forces.empty() || scene.gravity) add_body_forces(mesh, forces, d.system.f);
  d.system.K = assemble_stiffness(mesh, d.laws);
  const SideTable table(mesh);
  std::vector<Eigen::Triplet<double>> springs;
  for (const BoundarySpec& spec : scene.boundaries)
    d.boundary_sums.push_back(apply(mesh, table, names, spec, d.system, springs));
  if (!springs.empty()) {
    d.springs.resize(d.system.K.rows(), d.system.K.cols());
    d.springs.setFromTriplets(springs.begin(), springs.end());
    d.system.K += d.springs;
    d.system.constraints.springs = spring_rows(d.springs);
  }
  for (const ElasticLaw& law : d.laws) d.system.stiffness_scale = std::max(d.system.stiffness_scale, law.young);
  return d;
}

VecX spring_forces(const Discretisation& d, const VecX& u) {
  if (d.springs.cols() == 0) return VecX::Zero(u.size());
  return -(d.springs.selfadjointView<Eigen::Lower>() * u);
}

double strain_energy(const Discretisation& d, const VecX& u) {
  const VecX forces = d.system.K.selfadjointView<Eigen::Lower>() * u + spring_forces(d, u);
  return 0.5 * u.dot(forces) - u.dot(d.initial_load) + d.initial_energy;
}

}  // namespace mortise
