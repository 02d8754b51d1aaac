#include "problem/discretisation.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "fem/elements.hpp"
#include "fem/resolved_loads.hpp"
#include "problem/body_fields.hpp"
#include "problem/boundary_conditions.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

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

// The material of each body of the mesh, and the initial strain upon it.
std::vector<ElasticLaw> laws_of(const Entries& entries) {
  std::vector<ElasticLaw> laws;
  for (int b = 0; b < int(entries.body_of.size()); ++b) {
    const Material& material = entries.material(b);
    StrainField strain;
    if (const int i = entries.initial_strain_of[b]; i >= 0 && !is_zero(entries.initial_strains[i]))
      strain = strain_of(entries.initial_strains[i], material.thermal_expansion);
    laws.push_back(law_of(material, entries.model, std::move(strain)));
  }
  return laws;
}

// Empty where no field varies.
CellRules rules_of(const BodyFields& fields) {
  if (!fields.any()) return {};
  return [&fields](const Cell& cell) { return fields.rule(cell); };
}

BodyFields strain_fields(const Entries& entries, const Mesh& mesh) {
  BodyFields fields(mesh);
  for (int b = 0; b < int(entries.initial_strain_of.size()); ++b)
    if (const int i = entries.initial_strain_of[b]; i >= 0) add_strain(entries.initial_strains[i], b, fields);
  fields.find_scales();
  return fields;
}

Resultant add_body_force(const Entries& entries, const Mesh& mesh, int number, VecX& f) {
  const VectorField& force = entries.body_forces[number].force;
  std::vector<BodyForce> forces(mesh.bodies.size());
  BodyFields fields(mesh);
  for (int b = 0; b < int(forces.size()); ++b) {
    if (entries.body_force_of[b] != number) continue;
    forces[b] = [&force](const Vec2& x) { return force(x); };
    fields.add(b, force.x);
    fields.add(b, force.y);
  }
  fields.find_scales();
  return add_body_forces(mesh, entries.model, forces, rules_of(fields), f);
}

Resultant add_gravity(const Entries& entries, const Mesh& mesh, VecX& f) {
  std::vector<BodyForce> weights;
  for (int b = 0; b < int(mesh.bodies.size()); ++b)
    weights.emplace_back([force = Vec2(entries.material(b).density * *entries.gravity)](const Vec2&) { return force; });
  return add_body_forces(mesh, entries.model, weights, f);
}

// All that lies on boundaries; the entries of springs are returned.
Triplets apply_boundaries(const Entries& entries, const Mesh& mesh, Discretisation& d) {
  Triplets springs;
  d.boundary_sums.clear();
  for (const BoundaryEntry& entry : entries.boundaries)
    d.boundary_sums.push_back(apply(mesh, d.model, entry, d.system, springs));
  return springs;
}

void add_springs(const Triplets& springs, Discretisation& d) {
  if (springs.empty()) return;
  d.springs = filled(d.system.K.rows(), d.system.K.cols(), springs);
  d.system.constraints.springs = spring_rows(d.springs);
  d.system.constraints.spring_parts = spring_parts(d.springs, d.system.K);
  d.system.K += d.springs;
}

void apply_multipoint(const Entries& entries, const Mesh& mesh, Discretisation& d) {
  d.multipoint = add_multipoint_supports(entries.boundaries, mesh, d.system);
  for (const RigidSupport& support : d.multipoint.rigid_curves) {
    const auto& rigid = std::get<RigidSpec>(entries.boundaries[support.entry].spec.what);
    d.boundary_sums[support.entry].add(support.curve.about, rigid.force);
    d.boundary_sums[support.entry].add_moment(rigid.moment, std::abs(support.curve.arm));
  }
}

// Into the bodies: initial strains, body forces, weight.
void load_bodies(const Entries& entries, const Mesh& mesh, Discretisation& d) {
  d.laws = laws_of(entries);
  d.system.constraints = no_constraints(mesh);
  if (d.model.axisymmetric()) hold_axis(mesh, d.system.constraints);
  d.initial_load = VecX::Zero(2 * mesh.nodes.rows());
  const BodyFields strains = strain_fields(entries, mesh);
  d.initial_energy = add_initial_strain(mesh, d.laws, rules_of(strains), d.initial_load);
  d.system.f = d.initial_load;
  d.body_sums.clear();
  for (int i = 0; i < int(entries.body_forces.size()); ++i)
    d.body_sums.push_back(add_body_force(entries, mesh, i, d.system.f));
  d.weight = entries.gravity ? add_gravity(entries, mesh, d.system.f) : Resultant();
}

}  // namespace

Discretisation discretise(const Entries& entries, const Mesh& mesh) {
  check_cells(mesh);
  Discretisation d;
  d.model = entries.model;
  load_bodies(entries, mesh, d);
  d.system.K = assemble_stiffness(mesh, d.laws, solver_threads());
  add_springs(apply_boundaries(entries, mesh, d), d);
  apply_multipoint(entries, mesh, d);
  d.system.stiffness_scale = 0;
  for (const ElasticLaw& law : d.laws) d.system.stiffness_scale = std::max(d.system.stiffness_scale, law.young);
  return d;
}

void take_loads(const Entries& entries, const Mesh& mesh, Discretisation& d) {
  SparseMatrix springs = std::move(d.system.constraints.springs);
  VecX parts = std::move(d.system.constraints.spring_parts);
  load_bodies(entries, mesh, d);
  apply_boundaries(entries, mesh, d);
  d.system.constraints.springs = std::move(springs);
  d.system.constraints.spring_parts = std::move(parts);
  apply_multipoint(entries, mesh, d);
}

VecX spring_forces(const Discretisation& d, const VecX& u) {
  if (d.springs.cols() == 0) return VecX::Zero(u.size());
  return -(d.springs.selfadjointView<Eigen::Lower>() * u);
}

double strain_energy(const Discretisation& d, const VecX& u) {
  return strain_energy(d, u, d.system.K.selfadjointView<Eigen::Lower>() * u);
}

double strain_energy(const Discretisation& d, const VecX& u, const VecX& Ku) {
  return 0.5 * u.dot(Ku + spring_forces(d, u)) - u.dot(d.initial_load) + d.initial_energy;
}

}  // namespace mortise
