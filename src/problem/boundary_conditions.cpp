#include "problem/boundary_conditions.hpp"

#include <sstream>

#include "base/printable.hpp"
#include "fem/arc_length.hpp"
#include "fem/assembly.hpp"
#include "fem/constraints.hpp"

namespace mortise {
namespace {

// A boundary that an entry names: its sides, and along it s, where the entry's fields ask for it.
struct NamedBoundary {
  int boundary;
  std::vector<CellSide> sides;  // in the order of the curve, where s is asked for
  std::optional<ArcLength> s;
};

bool uses_arc_length(const BoundarySpec& spec) {
  const auto uses = [](const auto& field) { return field && field->uses_arc_length(); };
  return uses(spec.displacement_x) || uses(spec.displacement_y) || uses(spec.pressure) || uses(spec.traction) ||
         uses(spec.normal_foundation) || uses(spec.foundation);
}

std::vector<NamedBoundary> boundaries_of(const Mesh& mesh, const SideTable& table, const SceneNames& names,
                                         const BoundarySpec& spec) {
  std::vector<NamedBoundary> list;
  for (const std::string& name : spec.on)
    for (const int boundary : names.boundaries(spec.key + ".on", name)) {
      NamedBoundary& on = list.emplace_back(NamedBoundary{boundary, {}, {}});
      if (uses_arc_length(spec)) {
        const Curve curve = contact_curve(mesh, boundary, table);
        on.sides = curve.sides;
        on.s.emplace(mesh.nodes, curve);
      } else if (spec.is_load() || spec.is_foundation()) {
        on.sides = sides_of(mesh, mesh.boundaries[boundary], table);
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

// Calls visit(sides, s(x)): all sides at once, or one by one where s is asked for.
template <typename Visit>
void for_each_piece(const NamedBoundary& on, Visit visit) {
  if (!on.s) return visit(on.sides, [](const Vec2&) { return 0.0; });
  for (int e = 0; e < int(on.sides.size()); ++e)
    visit(std::vector<CellSide>{on.sides[e]}, [&on, e](const Vec2& x) { return on.s->at(e, x); });
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

Resultant add_loads(const Mesh& mesh, const Model& model, const BoundarySpec& spec,
                    const std::vector<NamedBoundary>& boundaries, VecX& f) {
  const Vec2 of_force = spec.force ? traction_of_force(mesh, model, spec, boundaries) : Vec2::Zero();
  Resultant sum;
  for (const NamedBoundary& on : boundaries)
    for_each_piece(on, [&](const std::vector<CellSide>& sides, const auto& s) {
      const Traction traction = [&](const Vec2& x, const Vec2& n) -> Vec2 {
        if (spec.pressure) return -(*spec.pressure)(x, s(x)) * n;
        return spec.traction ? (*spec.traction)(x, s(x)) : of_force;
      };
      sum += add_traction(mesh, model, sides, traction, f);
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

void add_springs(const Mesh& mesh, const Model& model, const BoundarySpec& spec, const NamedBoundary& on,
                 std::vector<Eigen::Triplet<double>>& springs) {
  for_each_piece(on, [&](const std::vector<CellSide>& sides, const auto& s) {
    const Foundation foundation = [&](const Vec2& x, const Vec2& n) -> Eigen::Matrix2d {
      if (spec.normal_foundation) return modulus(spec, *spec.normal_foundation, x, s(x)) * n * n.transpose();
      const Field &along_x = spec.foundation->x, &along_y = spec.foundation->y;
      return Vec2(modulus(spec, along_x, x, s(x)), modulus(spec, along_y, x, s(x))).asDiagonal();
    };
    add_foundation(mesh, model, sides, foundation, springs);
  });
}

}  // namespace

Resultant apply(const Mesh& mesh, const Model& model, const SideTable& table, const SceneNames& names,
                const BoundarySpec& spec, SaddlePointSystem& system, std::vector<Eigen::Triplet<double>>& springs) {
  const std::vector<NamedBoundary> boundaries = boundaries_of(mesh, table, names, spec);
  for (const NamedBoundary& on : boundaries) {
    prescribe(mesh, on, 0, spec.displacement_x, system.constraints);
    prescribe(mesh, on, 1, spec.displacement_y, system.constraints);
    if (spec.is_foundation()) add_springs(mesh, model, spec, on, springs);
  }
  return spec.is_load() ? add_loads(mesh, model, spec, boundaries, system.f) : Resultant();
}

}  // namespace mortise
