#include "problem/discretisation.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "base/patterns.hpp"
#include "fem/elements.hpp"
#include "mesh/side_table.hpp"
#include "problem/scene_names.hpp"

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
std::vector<ElasticLaw> laws_of(const Scene& scene, const Mesh& mesh, const SceneNames& names) {
  const std::vector<const Material*> materials = materials_of(scene, mesh, names);
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
    StrainField strain;
    if (!strains[b].isZero(0)) strain = [of_body = strains[b]](const Vec2&) { return of_body; };
    laws.push_back(elastic_law(materials[b]->young, materials[b]->poisson, scene.model, std::move(strain)));
  }
  return laws;
}

// The sum of the nodal forces that the entry makes.
Vec2 apply(const Mesh& mesh, const Model& model, const SideTable& table, const SceneNames& names,
           const BoundarySpec& spec, SaddlePointSystem& system) {
  Vec2 sum = Vec2::Zero();
  for (const std::string& name : spec.on)
    for (const int boundary : names.boundaries(spec.key + ".on", name)) {
      if (spec.displacement_x) prescribe(mesh, boundary, 0, *spec.displacement_x, system.constraints);
      if (spec.displacement_y) prescribe(mesh, boundary, 1, *spec.displacement_y, system.constraints);
      if (!spec.pressure && !spec.traction) continue;
      const std::vector<CellSide> sides = sides_of(mesh, mesh.boundaries[boundary], table);
      if (spec.pressure)
        sum += add_traction(
            mesh, model, sides, [&](const Vec2&, const Vec2& n) -> Vec2 { return -*spec.pressure * n; }, system.f);
      if (spec.traction)
        sum += add_traction(
            mesh, model, sides, [&](const Vec2&, const Vec2&) -> Vec2 { return *spec.traction; }, system.f);
    }
  return sum;
}

}  // namespace

Discretisation discretise(const Scene& scene, const Mesh& mesh) {
  check_cells(mesh);
  Discretisation d;
  d.model = scene.model;
  d.system.stiffness_scale = 0;
  const SceneNames names(mesh);
  d.laws = laws_of(scene, mesh, names);
  d.system.constraints = no_constraints(mesh);
  if (d.model.axisymmetric()) hold_axis(mesh, d.system.constraints);
  d.initial_load = VecX::Zero(2 * mesh.nodes.rows());
  d.initial_energy = add_initial_strain(mesh, d.laws, d.initial_load);
  d.system.f = d.initial_load;
  for (const BodyForceSpec& spec : scene.body_forces) {
    std::vector<BodyForce> forces(mesh.bodies.size());
    for (const int body : names.bodies(spec.key, spec.body)) forces[body] = [&](const Vec2&) { return spec.force; };
    d.body_sums.push_back(add_body_forces(mesh, d.model, forces, d.system.f));
  }
  const SideTable table(mesh);
  for (const BoundarySpec& spec : scene.boundaries)
    d.boundary_sums.push_back(apply(mesh, d.model, table, names, spec, d.system));
  d.system.K = assemble_stiffness(mesh, d.laws);
  for (const ElasticLaw& law : d.laws) d.system.stiffness_scale = std::max(d.system.stiffness_scale, law.young);
  return d;
}

double strain_energy(const Discretisation& d, const VecX& u) {
  const VecX Ku = d.system.K.selfadjointView<Eigen::Lower>() * u;
  return 0.5 * u.dot(Ku) - u.dot(d.initial_load) + d.initial_energy;
}

}  // namespace mortise
