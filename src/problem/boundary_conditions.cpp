#include "problem/boundary_conditions.hpp"

#include "base/overloaded.hpp"
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
Vec2 traction_of_force(const Mesh& mesh, const Model& model, const BoundaryEntry& entry, const Vec2& force) {
  VecX unused = VecX::Zero(2 * mesh.nodes.rows());
  const auto unit = [](const Vec2&, const Vec2&) -> Vec2 { return Vec2::UnitX(); };
  double area = 0;
  for (const NamedBoundary& on : entry.curves) area += add_traction(mesh, model, on.sides, unit, unused).force.x();
  if (!(area > 0))
    throw SceneError(entry.spec.key + ".force: its curves have no length; expected some to put the force on");
  return force / area;
}

// An equal part of the force at each node.
Resultant add_force(const Mesh& mesh, const Vec2& force, const std::vector<int>& points, VecX& f) {
  std::size_t count = 0;
  for (const int point : points) count += mesh.points[point].nodes.size();
  Resultant sum;
  for (const int point : points)
    for (const int node : mesh.points[point].nodes) {
      f.segment<2>(2 * node) += force / double(count);
      sum.add(mesh.nodes.row(node).transpose(), force / double(count));
    }
  return sum;
}

Resultant add_load(const Mesh& mesh, const Model& model, const BoundaryEntry& entry, const TractionField& traction,
                   VecX& f) {
  const BoundaryFields fields(mesh, entry.curves, fields_of(entry.spec.what));
  Resultant sum;
  for (const NamedBoundary& on : entry.curves)
    for_each_piece(mesh, on, fields, [&](const std::vector<CellSide>& sides, const auto& s, const EdgeCuts& cuts) {
      sum += add_traction(
          mesh, model, CutSides{sides, cuts},
          [&](const Vec2& x, const Vec2& n) -> Vec2 { return traction(x, n, s(x)); }, f);
    });
  return sum;
}

// The value of a foundation's field, which an expression may make negative.
double modulus(const BoundarySpec& spec, const Field& field, const Vec2& x, double s) {
  const double k = field(x, s);
  if (k >= 0) return k;
  throw SceneError(
      worded(spec.key, ".foundation: '", field.words(), "' is ", k, " ", near_point(x), "; expected a modulus >= 0"));
}

// `stiffness` at a place, with its outward normal and s.
template <typename AtPlace>
void add_springs(const Mesh& mesh, const Model& model, const BoundaryEntry& entry, const AtPlace& stiffness,
                 Triplets& springs) {
  const BoundaryFields fields(mesh, entry.curves, fields_of(entry.spec.what));
  for (const NamedBoundary& on : entry.curves)
    for_each_piece(mesh, on, fields, [&](const std::vector<CellSide>& sides, const auto& s, const EdgeCuts& cuts) {
      add_foundation(
          mesh, model, {sides, cuts},
          [&](const Vec2& x, const Vec2& n) -> Eigen::Matrix2d { return stiffness(x, n, s(x)); }, springs);
    });
}

// Along x and y.
void prescribe(const Mesh& mesh, const BoundaryEntry& entry, const Displacement& u, Constraints& constraints) {
  for (const int p : entry.points)
    for (const int node : mesh.points[p].nodes) {
      const Vec2 x = mesh.nodes.row(node).transpose();
      if (u.x) prescribe(mesh, mesh.points[p].name, 2 * node, (*u.x)(x), constraints);
      if (u.y) prescribe(mesh, mesh.points[p].name, 2 * node + 1, (*u.y)(x), constraints);
    }
  prescribe(mesh, entry.curves, 0, u.x, constraints);
  prescribe(mesh, entry.curves, 1, u.y, constraints);
}

void add_point_springs(const Mesh& mesh, const BoundaryEntry& entry, const Vec2& stiffness, Triplets& springs) {
  for (const int point : entry.points)
    for (const int node : mesh.points[point].nodes)
      for (int c = 0; c < 2; ++c)
        if (stiffness(c) > 0) springs.emplace_back(2 * node + c, 2 * node + c, stiffness(c));
}

}  // namespace

TractionField traction_of(const Mesh& mesh, const Model& model, const BoundaryEntry& entry) {
  const BoundaryCondition& what = entry.spec.what;
  if (const auto* p = std::get_if<Pressure>(&what))
    return [p = *p](const Vec2& x, const Vec2& n, double s) -> Vec2 { return -p.value(x, s) * n; };
  if (const auto* t = std::get_if<SurfaceTraction>(&what))
    return [t = *t](const Vec2& x, const Vec2&, double s) -> Vec2 { return t.value(x, s); };
  if (const auto* force = std::get_if<TotalForce>(&what); force && entry.points.empty())
    return [t = traction_of_force(mesh, model, entry, force->value)](const Vec2&, const Vec2&, double) { return t; };
  return {};
}

Resultant apply(const Mesh& mesh, const Model& model, const BoundaryEntry& entry, SaddlePointSystem& system,
                Triplets& springs) {
  const BoundarySpec& spec = entry.spec;
  Resultant sum;
  if (const TractionField traction = traction_of(mesh, model, entry))
    return add_load(mesh, model, entry, traction, system.f);
  std::visit(Overloaded{[&](const Displacement& u) {
                          told_with_key(entry.spec.key, [&] { prescribe(mesh, entry, u, system.constraints); });
                        },
                        [](const NormalDisplacement&) {}, [](const DirectedDisplacement&) {}, [](const RigidSpec&) {},
                        [](const Pressure&) {}, [](const SurfaceTraction&) {},
                        [&](const TotalForce& force) { sum = add_force(mesh, force.value, entry.points, system.f); },
                        [&](const NormalFoundation& k) {
                          const auto normal = [&](const Vec2& x, const Vec2& n, double s) -> Eigen::Matrix2d {
                            return modulus(spec, k.modulus, x, s) * n * n.transpose();
                          };
                          add_springs(mesh, model, entry, normal, springs);
                        },
                        [&](const AxesFoundation& k) {
                          const auto axes = [&](const Vec2& x, const Vec2&, double s) -> Eigen::Matrix2d {
                            return Vec2(modulus(spec, k.moduli.x, x, s), modulus(spec, k.moduli.y, x, s)).asDiagonal();
                          };
                          add_springs(mesh, model, entry, axes, springs);
                        },
                        [&](const PointSpring& k) { add_point_springs(mesh, entry, k.stiffness, springs); }},
             spec.what);
  return sum;
}

}  // namespace mortise
