#include "problem/discretisation.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "fem/elements.hpp"
#include "fem/resolved_loads.hpp"
#include "mesh/side_table.hpp"
#include "problem/body_entries.hpp"
#include "problem/body_fields.hpp"
#include "problem/boundary_conditions.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

// Of each body; nullptr: none.
std::vector<const Material*> materials_of(const Scene& scene, const Mesh& mesh, const SceneNames& names) {
  std::vector<BodyEntry> entries;
  for (const BodySpec& spec : scene.bodies) entries.push_back({"bodies." + spec.name, spec.name});
  const auto twice = [&](const std::string& body, std::size_t i, std::size_t j) {
    const BodySpec &first = scene.bodies[i], &second = scene.bodies[j];
    if (first.material == second.material) return;
    throw SceneError("bodies: body '" + body + "' is a '" + first.name + "' of '" + first.material + "' and a '" +
                     second.name + "' of '" + second.material + "'; expected one material");
  };
  std::vector<const Material*> materials;
  for (const int i : entries_of_bodies(mesh, names, entries, twice))
    materials.push_back(i >= 0 ? &scene.materials.at(scene.bodies[i].material) : nullptr);
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
  const std::vector<int> entries = loads_of(scene.initial_strains, mesh, names);
  for (std::size_t b = 0; b < entries.size(); ++b) {
    if (entries[b] < 0 || !materials[b]) continue;
    const InitialStrainSpec& spec = scene.initial_strains[entries[b]];
    if (!is_zero(spec)) strains[b] = strain_of(spec, materials[b]->thermal_expansion);
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

// Empty where no field varies.
CellRules rules_of(const BodyFields& fields) {
  if (!fields.any()) return {};
  return [&fields](const Cell& cell) { return fields.rule(cell); };
}

BodyFields strain_fields(const Scene& scene, const Mesh& mesh, const SceneNames& names) {
  BodyFields fields(mesh);
  const std::vector<int> entries = loads_of(scene.initial_strains, mesh, names);
  for (int b = 0; b < int(entries.size()); ++b)
    if (entries[b] >= 0) add_strain(scene.initial_strains[entries[b]], b, fields);
  fields.find_scales();
  return fields;
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
  const BodyFields strains = strain_fields(scene, mesh, names);
  d.initial_energy = add_initial_strain(mesh, d.laws, rules_of(strains), d.initial_load);
  d.system.f = d.initial_load;
  const std::vector<int> body_forces = loads_of(scene.body_forces, mesh, names);
  for (std::size_t i = 0; i < scene.body_forces.size(); ++i) {
    std::vector<BodyForce> forces(mesh.bodies.size());
    const VectorField& force = scene.body_forces[i].force;
    BodyFields fields(mesh);
    for (int b = 0; b < int(forces.size()); ++b) {
      if (body_forces[b] != int(i)) continue;
      forces[b] = [&force](const Vec2& x) { return force(x); };
      fields.add(b, force.x);
      fields.add(b, force.y);
    }
    fields.find_scales();
    d.body_sums.push_back(add_body_forces(mesh, d.model, forces, rules_of(fields), d.system.f));
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
