#include "problem/boundary_places.hpp"

#include <algorithm>

namespace mortise {
namespace {

bool uses_arc_length(const BoundarySpec& spec) {
  return std::ranges::any_of(fields_of(spec), [](const Field* field) { return field->uses_arc_length(); });
}

// Throws SceneError where an entry names a point that acts along curves, or the other way round.
void require_kind(const BoundarySpec& spec, const std::string& name, const SceneNames::Places& found) {
  const auto refuse = [&](const std::string& why) { throw SceneError(spec.key + ".on: '" + name + "' is " + why); };
  if (!found.boundaries.empty() && spec.spring)
    refuse("a curve; expected a physical point for a spring (along curves: 'foundation')");
  if (found.points.empty()) return;
  if (spec.pressure || spec.traction) refuse("a point; expected a curve, or 'force' at a point");
  if (spec.is_foundation()) refuse("a point; expected a curve, or 'spring' at a point");
  if (spec.rigid || spec.displacement_normal) refuse("a point; expected a curve");
  if (uses_arc_length(spec)) refuse("a point, which has no s; expected an expression in x, y, r, theta");
}

}  // namespace

std::vector<const Field*> fields_of(const BoundarySpec& spec) {
  std::vector<const Field*> fields;
  for (const auto* field : {&spec.displacement_x, &spec.displacement_y, &spec.displacement_normal,
                            &spec.displacement_along, &spec.pressure, &spec.normal_foundation})
    if (*field) fields.push_back(&**field);
  for (const auto* vector : {&spec.traction, &spec.foundation})
    if (*vector) fields.insert(fields.end(), {&(*vector)->x, &(*vector)->y});
  return fields;
}

Places places_of(const Mesh& mesh, const SideTable& table, const SceneNames& names, const BoundarySpec& spec) {
  Places list;
  for (const std::string& name : spec.on) {
    const SceneNames::Places found = names.places(spec.key + ".on", name);
    require_kind(spec, name, found);
    for (const int point : found.points) list.points.push_back(&mesh.points[point]);
    for (const int boundary : found.boundaries) {
      NamedBoundary& on = list.boundaries.emplace_back(NamedBoundary{boundary, {}, {}});
      if (uses_arc_length(spec)) {
        const Curve curve = contact_curve(mesh, boundary, table);
        on.sides = curve.sides;
        on.s.emplace(mesh.nodes, curve);
      } else if (spec.is_load() || spec.is_foundation() || spec.displacement_normal) {
        on.sides = sides_of(mesh, mesh.boundaries[boundary], table);
      }
    }
  }
  if (spec.force && !list.points.empty() && !list.boundaries.empty())
    throw SceneError(spec.key + ".force: acts on curves and on points; expected one kind, as its sum is shared");
  return list;
}

}  // namespace mortise
