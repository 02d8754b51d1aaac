#include "problem/take_loads.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "contact/gap_resolution.hpp"
#include "contact/segments.hpp"
#include "problem/ties.hpp"
#include "scene/scene.hpp"

namespace mortise {
namespace {

// Of entries whose functions of place change, s along their curves may be asked for now.
void take_boundaries(const Scene& scene, const Mesh& mesh, std::vector<BoundaryEntry>& entries) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].spec == scene.boundaries[i]) continue;
    const bool constant = std::ranges::all_of(fields_of(scene.boundaries[i].what), &Field::is_constant);
    if (constant)
      entries[i].spec = scene.boundaries[i];
    else
      entries[i] = boundary_entries({scene.boundaries[i]}, mesh, SideTable(mesh), SceneNames(mesh))[0];
  }
}

void take_entries(const Scene& scene, const Mesh& mesh, Entries& entries) {
  take_boundaries(scene, mesh, entries.boundaries);
  entries.materials = scene.materials;
  entries.body_forces = scene.body_forces;
  entries.initial_strains = scene.initial_strains;
  entries.gravity = scene.gravity;
}

bool same_rows(const Coupling& a, const Coupling& b) {
  return a.row == b.row && a.scale == b.scale && a.B.nonZeros() == b.B.nonZeros() && (a.B - b.B).norm() == 0;
}

// The gap of a pair, and its rows with it; false where these are others. What of rows is left out may hang on
// prescribed displacements where both sides' are.
bool take_gap(const ContactSpec& spec, const Problem& p, ContactPair& of) {
  if (of.spec.gap == spec.gap && of.spec.clearance == spec.clearance &&
      std::ranges::none_of(of.coupling.dropped, &DroppedMultiplier::faces))
    return true;
  ContactPair pair = of;
  pair.spec.gap = spec.gap;
  pair.spec.clearance = spec.clearance;
  if (spec.initial_gap == InitialGap::given) pair.geometry.given = spec.gap;
  pair.geometry.clearance = spec.clearance;
  pair.geometry.one_line.clear();
  if (spec.gap.uses_arc_length() || spec.clearance.uses_arc_length())
    pair.geometry.s.emplace(p.mesh.nodes, pair.multiplier);
  pair.points = contact_points(p.mesh.nodes, pair, p.method.integration);
  find_one_line(p.mesh.nodes, pair);
  pair.coupling = told_with_key(spec.key, [&] {
    return couple(p.mesh, pair, p.discretisation.system.constraints, {p.method.multipliers, spec.initial_gap});
  });
  const bool same = same_rows(pair.coupling, of.coupling);
  of = std::move(pair);
  return same;
}

bool take_gaps(const Scene& scene, Problem& p) {
  for (ContactPair& pair : p.pairs) {
    const auto spec = std::ranges::find(scene.contacts, pair.spec.key, &ContactSpec::key);
    if (spec == scene.contacts.end() || !take_gap(*spec, p, pair)) return false;
    pair.spec.fluid = spec->fluid;
    p.discretisation.system.g.segment(pair.first_row, pair.coupling.gap0.size()) = -pair.coupling.gap0;
  }
  return true;
}

}  // namespace

bool take_loads(const Scene& scene, Problem& p) {
  take_entries(scene, p.mesh, p.entries);
  take_pretensions(scene, p.mesh);
  p.fields = scene.fields;
  p.expectations = scene.expectations;
  SaddlePointSystem& system = p.discretisation.system;
  std::vector<char> fixed = std::move(system.constraints.fixed);
  p.load_case = scene.load_case;
  take_loads(p.entries, p.mesh, p.discretisation);
  system.constraints.fixed = std::move(fixed);  // with held motions
  refuse_driven(p.mesh, p.pairs, p.held.motions, {}, system.f);
  std::vector<DataMisfit> outline = std::move(p.misfits.parts);
  std::erase_if(outline, [](const DataMisfit& part) { return part.kind != DataMisfit::Kind::outline; });
  p.misfits = data_misfits(p.entries, p.mesh, p.discretisation.laws);
  std::ranges::move(outline, std::back_inserter(p.misfits.parts));
  p.fluid.setZero();
  return take_gaps(scene, p);
}

}  // namespace mortise
