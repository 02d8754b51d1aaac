#include "problem/discretisation.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "base/patterns.hpp"
#include "fem/elements.hpp"
#include "mesh/side_table.hpp"
#include "problem/boundary_conditions.hpp"
#include "solve/threads.hpp"

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

ElasticLaw law_of(const Material& m, const Model& model, StrainField strain) {
  if (!m.stiffness) return elastic_law(m.young, m.poisson, model, std::move(strain));
  const Mat4 stiffness = model.plane == Plane::stress ? without_33(*m.stiffness) : *m.stiffness;
  return elastic_law(stiffness, model, m.young, std::move(strain));
}

// Whether an entry's strain is zero everywhere.
bool is_zero(const InitialStrainSpec& spec) {
  const auto zero = [](const Field& field) { return field == Field(); };
  return spec.temperature_change ? zero(*spec.temperature_change) : std::ranges::all_of(spec.strain, zero);
}

StrainField strain_of(const InitialStrainSpec& spec, double expansion) {
  if (spec.temperature_change)
    return [change = *spec.temperature_change, expansion](const Vec2& x) -> Vec4 {
      return expansion * change(x) * Vec4(1, 1, 1, 0);
    };
  return [e = spec.strain](const Vec2& x) { return Vec4(e[0](x), e[1](x), e[2](x), e[3](x)); };
}

// Of each body, empty where there is none.
std::vector<StrainField> strains_of(const Scene& scene, const Mesh& mesh, const SceneNames& names,
                                    const std::vector<const Material*>& materials) {
  std::vector<StrainField> strains(mesh.bodies.size());
  for (const InitialStrainSpec& spec : scene.initial_strains)
    for (const int b : names.bodies(spec.key, spec.body)) {
      if (is_zero(spec) || !materials[b]) continue;
      const StrainField strain = strain_of(spec, materials[b]->thermal_expansion), before = strains[b];
      if (before)
        strains[b] = [=](const Vec2& x) -> Vec4 { return before(x) + strain(x); };
      else
        strains[b] = strain;
    }
  return strains;
}

// The material of each body of the mesh, and the initial strain upon it.
std::vector<ElasticLaw> laws_of(const Scene& scene, const Mesh& mesh, const SceneNames& names,
                                const std::vector<const Material*>& materials) {
  std::vector<StrainField> strains = strains_of(scene, mesh, names, materials);
  std::vector<ElasticLaw> laws;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    if (!materials[b]) throw SceneError("bodies: body '" + mesh.bodies[b] + "' of " + mesh.source + " has no material");
    laws.push_back(law_of(*materials[b], scene.model, std::move(strains[b])));
  }
  return laws;
}

}  // namespace

Discretisation discretise(const Scene& scene, const Mesh& mesh) {
  check_cells(mesh);
  Discretisation d;
  d.model = scene.model;
  d.system.stiffness_scale = 0;
  const SceneNames names(mesh);
  const std::vector<const Material*> materials = materials_of(scene, mesh, names);
  d.laws = laws_of(scene, mesh, names, materials);
  d.system.constraints = no_constraints(mesh);
  if (d.model.axisymmetric()) hold_axis(mesh, d.system.constraints);
  d.initial_load = VecX::Zero(2 * mesh.nodes.rows());
  d.initial_energy = add_initial_strain(mesh, d.laws, d.initial_load);
  d.system.f = d.initial_load;
  for (const BodyForceSpec& spec : scene.body_forces) {
    std::vector<BodyForce> forces(mesh.bodies.size());
    for (const int body : names.bodies(spec.key, spec.body))
      forces[body] = [&](const Vec2& x) { return spec.force(x); };
    d.body_sums.push_back(add_body_forces(mesh, d.model, forces, d.system.f));
  }
  if (scene.gravity) {
    std::vector<BodyForce> weights;
    for (const Material* material : materials)
      weights.emplace_back([force = Vec2(material->density * *scene.gravity)](const Vec2&) { return force; });
    d.weight = add_body_forces(mesh, d.model, weights, d.system.f);
  }
  d.system.K = assemble_stiffness(mesh, d.laws, solver_threads());
  const SideTable table(mesh);
  std::vector<Eigen::Triplet<double>> springs;
  for (const BoundarySpec& spec : scene.boundaries)
    d.boundary_sums.push_back(apply(mesh, d.model, table, names, spec, d.system, springs));
  if (!springs.empty()) {
    d.springs.resize(d.system.K.rows(), d.system.K.cols());
    d.springs.setFromTriplets(springs.begin(), springs.end());
    d.system.K += d.springs;
    d.system.constraints.springs = spring_rows(d.springs);
  }
  d.multipoint = add_multipoint_supports(scene, mesh, table, names, d.system);
  for (const RigidSupport& rigid : d.multipoint.rigid_curves) {
    const RigidSpec& spec = *scene.boundaries[rigid.entry].rigid;
    d.boundary_sums[rigid.entry].add(rigid.curve.about, spec.force);
    d.boundary_sums[rigid.entry].add_moment(spec.moment, std::abs(rigid.curve.arm));
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
