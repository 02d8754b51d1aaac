#include "problem/boundary_conditions.hpp"

#include <sstream>

#include "base/printable.hpp"
#include "fem/assembly.hpp"
#include "fem/constraints.hpp"
#include "fem/resolved_loads.hpp"
#include "problem/boundary_fields.hpp"

namespace mortise {
namespace {

void prescribe(const Mesh& mesh, const std::vector<NamedBoundary>& boundaries, int component,
               const std::optional<Field>& field, Constraints& constraints) {
  if (!field) return;
  const std::map<int, double> values = prescribed_values(mesh, boundaries, *field);
  const auto value = [&](int node) { return field->is_constant() ? field->constant() : values.at(node); };
  for (const NamedBoundary& on : boundaries) prescribe(mesh, on.boundary, component, value, constraints);
}

// Calls visit(sides, s(x), cuts): all sides at once, or one by one where s is asked for.
template <typename Visit>
void for_each_piece(const Mesh& mesh, const NamedBoundary& on, const BoundaryFields& fields, Visit visit) {
  const auto cut = [&](int e) {
    return [&mesh, &on, &fields, e](const Edge& edge) { return fields.cuts(on, e, edge); };
  };
  if (!on.s)
    return visit(
        on.sides, [](const Vec2&) { return 0.0; }, fields.any() ? EdgeCuts(cut(0)) : EdgeCuts());
  for (int e = 0; e < int(on.sides.size()); ++e)
    visit(
        std::vector<CellSide>{on.sides[e]}, [&on, e](const Vec2& x) { return on.s->at(e, x); }, EdgeCuts(cut(e)));
}

// The constant traction whose sum is the entry's force.
Vec2 traction_of_force(const Mesh& mesh, const Model& model, const BoundarySpec& spec,
                       const std::vector<NamedBoundary>& boundaries) {
  VecX unused = VecX::Zero(2 * mesh.nodes.rows());
  const auto unit = [](const Vec2&, const Vec2&) -> Vec2 { return Vec2::UnitX(); };
  double area = 0;
  for (const NamedBoundary& on : boundaries) area += add_traction(mesh, model, on.sides, unit, unused).force.x();
  if (!(area > 0)) throw SceneError(spec.key + ".force: its curves have no length; expected some to put the force on");
  return *spec.force / area;
}

// An equal part of the force at each node.
Resultant add_force(const Mesh& mesh, const Vec2& force, const std::vector<const NamedPoint*>& points, VecX& f) {
  std::size_t count = 0;
  for (const NamedPoint* point : points) count += point->nodes.size();
  Resultant sum;
  for (const NamedPoint* point : points)
    for (const int node : point->nodes) {
      f.segment<2>(2 * node) += force / double(count);
      sum.add(mesh.nodes.row(node).transpose(), force / double(count));
    }
  return sum;
}

Resultant add_loads(const Mesh& mesh, const Model& model, const BoundarySpec& spec,
                    const std::vector<NamedBoundary>& boundaries, VecX& f) {
  const Vec2 of_force = spec.force ? traction_of_force(mesh, model, spec, boundaries) : Vec2::Zero();
  const BoundaryFields fields(mesh, boundaries, fields_of(spec));
  Resultant sum;
  for (const NamedBoundary& on : boundaries)
    for_each_piece(mesh, on, fields, [&](const std::vector<CellSide>& sides, const auto& s, const EdgeCuts& cuts) {
      const Traction traction = [&](const Vec2& x, const Vec2& n) -> Vec2 {
        if (spec.pressure) return -(*spec.pressure)(x, s(x)) * n;
        return spec.traction ? (*spec.traction)(x, s(x)) : of_force;
      };
      sum += add_traction(mesh, model, sides, traction, cuts, f);
    });
  return sum;
}

// The value of a foundation's field, which an expression may make negative.
double modulus(const BoundarySpec& spec, const Field& field, const Vec2& x, double s) {
  const double k = field(x, s);
  if (k >= 0) return k;
  std::ostringstream text;
  text << spec.key << ".foundation: '" << field.words() << "' is " << k << " " << near_point(x)
       << "; expected a modulus >= 0";
  throw SceneError(text.str());
}

void add_springs(const Mesh& mesh, const Model& model, const BoundarySpec& spec,
                 const std::vector<NamedBoundary>& boundaries, std::vector<Eigen::Triplet<double>>& springs) {
  const BoundaryFields fields(mesh, boundaries, fields_of(spec));
  for (const NamedBoundary& on : boundaries)
    for_each_piece(mesh, on, fields, [&](const std::vector<CellSide>& sides, const auto& s, const EdgeCuts& cuts) {
      const Foundation foundation = [&](const Vec2& x, const Vec2& n) -> Eigen::Matrix2d {
        if (spec.normal_foundation) return modulus(spec, *spec.normal_foundation, x, s(x)) * n * n.transpose();
        const Field &along_x = spec.foundation->x, &along_y = spec.foundation->y;
        return Vec2(modulus(spec, along_x, x, s(x)), modulus(spec, along_y, x, s(x))).asDiagonal();
      };
      add_foundation(mesh, model, sides, foundation, springs, cuts);
    });
}

}  // namespace

Resultant apply(const Mesh& mesh, const Model& model, const SideTable& table, const SceneNames& names,
                const BoundarySpec& spec, SaddlePointSystem& system, std::vector<Eigen::Triplet<double>>& springs) {
  const Places on_all = places_of(mesh, table, names, spec);
  for (const NamedPoint* point : on_all.points)
    for (const int node : point->nodes) {
      const Vec2 x = mesh.nodes.row(node).transpose();
      if (const auto& u = spec.displacement_x) prescribe(mesh, point->name, node, 0, (*u)(x), system.constraints);
      if (const auto& u = spec.displacement_y) prescribe(mesh, point->name, node, 1, (*u)(x), system.constraints);
      for (int c = 0; c < 2 && spec.spring; ++c)
        if ((*spec.spring)(c) > 0) springs.emplace_back(2 * node + c, 2 * node + c, (*spec.spring)(c));
    }
  prescribe(mesh, on_all.boundaries, 0, spec.displacement_x, system.constraints);
  prescribe(mesh, on_all.boundaries, 1, spec.displacement_y, system.constraints);
  if (spec.is_foundation()) add_springs(mesh, model, spec, on_all.boundaries, springs);
  if (spec.force && !on_all.points.empty()) return add_force(mesh, *spec.force, on_all.points, system.f);
  return spec.is_load() ? add_loads(mesh, model, spec, on_all.boundaries, system.f) : Resultant();
}

}  // namespace mortise
