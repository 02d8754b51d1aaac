#include "problem/discretisation.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "base/patterns.hpp"
#include "fem/arc_length.hpp"
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
    laws.push_back(elastic_law(materials[b]->young, materials[b]->poisson, scene.plane, strains[b]));
  }
  return laws;
}

// A boundary that an entry names: its sides, and along it s, where the entry's fields ask for it.
struct NamedBoundary {
  int boundary;
  std::vector<CellSide> sides;  // in the order of s, where it is asked for
  std::optional<ArcLength> s;
};

bool uses_arc_length(const BoundarySpec& spec) {
  const auto uses = [](const auto& field) { return field && field->uses_arc_length(); };
  return uses(spec.displacement_x) || uses(spec.displacement_y) || uses(spec.pressure) || uses(spec.traction);
}

std::vector<NamedBoundary> boundaries_of(const Mesh& mesh, const SideTable& table, const SceneNames& names,
                                         const BoundarySpec& spec) {
  std::vector<NamedBoundary> list;
  for (const std::string& name : spec.on)
    for (const int boundary : names.boundaries(spec.key + ".on", name)) {
      if (uses_arc_length(spec)) {
        Curve curve = contact_curve(mesh, boundary, table);
        const ArcLength s(mesh.nodes, curve);
        list.push_back({boundary, std::move(curve.sides), s});
      } else {
        list.push_back({boundary,
                        spec.is_load() ? sides_of(mesh, mesh.boundaries[boundary], table) : std::vector<CellSide>{},
                        {}});
      }
    }
  return list;
}

void prescribe(const Mesh& mesh, const NamedBoundary& on, int component, const std::optional<Field>& field,
               Constraints& constraints) {
  if (!field) return;
  const auto value = [&](int node) {
    return (*field)(mesh.nodes.row(node).transpose(), on.s ? on.s->at_node(node) : 0);
  };
  prescribe(mesh, on.boundary, component, value, constraints);
}

// The sum of the nodal forces that a load (x, n, s) makes on a boundary.
template <typename Load>
Vec2 apply_load(const Mesh& mesh, const NamedBoundary& on, const Load& load, VecX& f) {
  if (!on.s)
    return add_traction(
        mesh, on.sides, [&](const Vec2& x, const Vec2& n) { return load(x, n, 0.0); }, f);
  Vec2 sum = Vec2::Zero();
  for (int e = 0; e < int(on.sides.size()); ++e)
    sum += add_traction(
        mesh, {on.sides[e]}, [&](const Vec2& x, const Vec2& n) { return load(x, n, on.s->at(e, x)); }, f);
  return sum;
}

// The constant traction whose sum is the entry's force.
Vec2 traction_of_force(const Mesh& mesh, const BoundarySpec& spec, const std::vector<NamedBoundary>& boundaries) {
  VecX unused = VecX::Zero(2 * mesh.nodes.rows());
  double area = 0;
  for (const NamedBoundary& on : boundaries)
    area += add_traction(
                mesh, on.sides, [](const Vec2&, const Vec2&) { return Vec2(Vec2::UnitX()); }, unused)
                .x();
  if (!(area > 0)) throw SceneError(spec.key + ".force: its curves have no length; expected some to put the force on");
  return *spec.force / area;
}

// The sum of the nodal forces that the entry makes.
Vec2 apply(const Mesh& mesh, const SideTable& table, const SceneNames& names, const BoundarySpec& spec,
           SaddlePointSystem& system) {
  const std::vector<NamedBoundary> boundaries = boundaries_of(mesh, table, names, spec);
  const Vec2 of_force = spec.force ? traction_of_force(mesh, spec, boundaries) : Vec2::Zero();
  const auto load = [&](const Vec2& x, const Vec2& n, double s) -> Vec2 {
    return spec.pressure ? Vec2(-(*spec.pressure)(x, s) * n) : spec.traction ? (*spec.traction)(x, s) : of_force;
  };
  Vec2 sum = Vec2::Zero();
  for (const NamedBoundary& on : boundaries) {
    prescribe(mesh, on, 0, spec.displacement_x, system.constraints);
    prescribe(mesh, on, 1, spec.displacement_y, system.constraints);
    if (spec.is_load()) sum += apply_load(mesh, on, load, system.f);
  }
  return sum;
}

}  // namespace

Discretisation discretise(const Scene& scene, const Mesh& mesh) {
  check_cells(mesh);
  Discretisation d;
  d.system.stiffness_scale = 0;
  const SceneNames names(mesh);
  d.laws = laws_of(scene, mesh, names);
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
  if (!scene.body_forces.empty()) add_body_forces(mesh, forces, d.system.f);
  const SideTable table(mesh);
  for (const BoundarySpec& spec : scene.boundaries)
    d.boundary_sums.push_back(apply(mesh, table, names, spec, d.system));
  d.system.K = assemble_stiffness(mesh, d.laws);
  for (const ElasticLaw& law : d.laws) d.system.stiffness_scale = std::max(d.system.stiffness_scale, law.young);
  return d;
}

double strain_energy(const Discretisation& d, const VecX& u) {
  const VecX Ku = d.system.K.selfadjointView<Eigen::Lower>() * u;
  return 0.5 * u.dot(Ku) - u.dot(d.initial_load) + d.initial_energy;
}

}  // namespace mortise
