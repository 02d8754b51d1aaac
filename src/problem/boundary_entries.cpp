#include "problem/boundary_entries.hpp"

#include <algorithm>

#include "base/overloaded.hpp"

namespace mortise {
namespace {

bool uses_arc_length(const BoundarySpec& spec) {
  return std::ranges::any_of(fields_of(spec.what), [](const Field* field) { return field->uses_arc_length(); });
}

// What a point has instead of this; empty where it may have it.
std::string instead_at_a_point(const BoundarySpec& spec) {
  const auto along_curves = [](const char* instead) { return "a point; expected a curve" + std::string(instead); };
  const std::string trouble =
      std::visit(Overloaded{[](const Displacement&) { return std::string(); },
                            [&](const NormalDisplacement&) { return along_curves(""); },
                            [](const DirectedDisplacement&) { return std::string(); },
                            [&](const RigidSpec&) { return along_curves(""); },
                            [&](const Pressure&) { return along_curves(", or 'force' at a point"); },
                            [&](const SurfaceTraction&) { return along_curves(", or 'force' at a point"); },
                            [](const TotalForce&) { return std::string(); },
                            [&](const NormalFoundation&) { return along_curves(", or 'spring' at a point"); },
                            [&](const AxesFoundation&) { return along_curves(", or 'spring' at a point"); },
                            [](const PointSpring&) { return std::string(); }},
                 spec.what);
  if (trouble.empty() && uses_arc_length(spec))
    return "a point, which has no s; expected an expression in x, y, r, theta";
  return trouble;
}

void require_kind(const BoundarySpec& spec, const std::string& name, const SceneNames::Places& found) {
  const auto refuse = [&](const std::string& why) { throw SceneError(spec.key + ".on: '" + name + "' is " + why); };
  if (!found.boundaries.empty() && std::holds_alternative<PointSpring>(spec.what))
    refuse("a curve; expected a physical point for a spring (along curves: 'foundation')");
  if (found.points.empty()) return;
  if (const std::string why = instead_at_a_point(spec); !why.empty()) refuse(why);
}

NamedBoundary named_boundary(const Mesh& mesh, const SideTable& table, const BoundarySpec& spec, int boundary) {
  NamedBoundary on{boundary, {}, {}};
  if (uses_arc_length(spec)) {
    const Curve curve = contact_curve(mesh, boundary, table);
    on.sides = curve.sides;
    on.s.emplace(mesh.nodes, curve);
  } else if (is_load(spec.what) || is_foundation(spec.what) || std::holds_alternative<NormalDisplacement>(spec.what)) {
    on.sides = sides_of(mesh, mesh.boundaries[boundary], table);
  }
  return on;
}

BoundaryEntry entry_of(const Mesh& mesh, const SideTable& table, const SceneNames& names, const BoundarySpec& spec) {
  BoundaryEntry entry{spec, {}, {}};
  for (const std::string& name : spec.on) {
    const SceneNames::Places found = names.places(spec.key + ".on", name);
    require_kind(spec, name, found);
    entry.points.insert(entry.points.end(), found.points.begin(), found.points.end());
    for (const int boundary : found.boundaries) entry.curves.push_back(named_boundary(mesh, table, spec, boundary));
  }
  if (std::holds_alternative<TotalForce>(spec.what) && !entry.points.empty() && !entry.curves.empty())
    throw SceneError(spec.key + ".force: acts on curves and on points; expected one kind, as its sum is shared");
  return entry;
}

}  // namespace

std::vector<BoundaryEntry> boundary_entries(const std::vector<BoundarySpec>& specs, const Mesh& mesh,
                                            const SideTable& table, const SceneNames& names) {
  std::vector<BoundaryEntry> entries;
  for (const BoundarySpec& spec : specs) entries.push_back(entry_of(mesh, table, names, spec));
  return entries;
}

}  // namespace mortise
