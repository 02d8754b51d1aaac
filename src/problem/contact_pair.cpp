#include "problem/contact_pair.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "base/errors.hpp"
#include "base/patterns.hpp"
#include "base/printable.hpp"
#include "fem/edges.hpp"
#include "mesh/body_points.hpp"
#include "mesh/thickness.hpp"
#include "problem/facing_pairs.hpp"
#include "problem/scene_names.hpp"

namespace mortise {

namespace {

// The curve that faces the other on nearly all of its length, where the other does not: 0 or 1, or -1 if there is none.
int covered_curve(const Points& nodes, const std::array<Curve, 2>& curves) {
  const double first = covered_part(nodes, curves[0], curves[1]), second = covered_part(nodes, curves[1], curves[0]);
  const double round_off = 1e-9;  // of a part that is exactly a limit
  if (std::max(first, second) < covered_limit - round_off) return -1;
  if (std::min(first, second) > uncovered_limit + round_off) return -1;
  return second > first ? 1 : 0;
}

// True if the multipliers lie on the second curve of a pair, where the scene does not say.
bool on_second(Scheme scheme, const Points& nodes, const ContactCurves& contact, const std::vector<ElasticLaw>& laws,
               const std::vector<char>& dirichlet) {
  const auto& [spec, curves, edge_size] = contact;
  // Equal meshes differ by round-off in their lengths: the first is the multiplier side then. So do those at a limit.
  constexpr double margin = 1e-6;
  const bool second_finer = edge_size[1] < (1 - margin) * edge_size[0],
             first_finer = edge_size[0] < (1 - margin) * edge_size[1];
  if (dirichlet.empty()) {
    const double first = contact_modulus(laws[curves[0].body]), second = contact_modulus(laws[curves[1].body]);
    if (std::max(first, second) > (1 + margin) * stiffer_limit * std::min(first, second)) return second < first;
    if (const int covered = covered_curve(nodes, curves); covered >= 0) return covered == 1;
    const double ratio = std::max(edge_size[0] / edge_size[1], edge_size[1] / edge_size[0]);
    const Curve& coarser = curves[second_finer ? 0 : 1];
    return coarser.edges[0].node_count == 2 && ratio > (1 + margin) * facet_limit ? !second_finer : second_finer;
  }
  if (scheme == Scheme::neumann_dirichlet) return dirichlet[curves[1].body];
  return first_finer;
}

void require_own_nodes(const Mesh& mesh, const ContactSpec& spec, const std::array<Curve, 2>& curves) {
  std::vector<int> first = curve_nodes(curves[0]);
  std::ranges::sort(first);
  for (const int node : curve_nodes(curves[1]))
    if (std::ranges::binary_search(first, node))
      throw InputError(mesh.source + ": " + spec.key + ": '" + spec.between[0] + "' and '" + spec.between[1] +
                       "' have a common node " + near_point(mesh.nodes.row(node).transpose()) +
                       "; expected curves with points of their own (in a .geo: a point and a curve for each body)");
}

// Whether the pairs of the entry find themselves.
bool is_found(const ContactSpec& spec) { return is_pattern(spec.between[0]) || is_pattern(spec.between[1]); }

std::array<std::vector<int>, 2> boundaries_of(const ContactSpec& spec, const SceneNames& names) {
  const std::string key = spec.key + ".between";
  return {names.boundaries(key, spec.between[0]), names.boundaries(key, spec.between[1])};
}

// A pattern may match those of several bodies, as a support's, and means others.
bool is_of_one_body(const Mesh& mesh, int boundary, const SideTable& table) {
  const std::vector<CellSide> sides = sides_of(mesh, mesh.boundaries[boundary], table);
  return std::ranges::all_of(
      sides, [&](const CellSide& side) { return mesh.cells[side.cell].body == mesh.cells[sides[0].cell].body; });
}

// Those that an entry of their own has, with its settings.
std::set<std::pair<int, int>> named_pairs(const Scene& scene, const SceneNames& names) {
  std::set<std::pair<int, int>> pairs;
  for (const ContactSpec& spec : scene.contacts) {
    if (is_found(spec)) continue;
    const auto sides = boundaries_of(spec, names);
    pairs.insert(std::minmax(sides[0][0], sides[1][0]));
  }
  return pairs;
}

void append(const SparseRows& rows, int first, std::vector<Eigen::Triplet<double>>& entries) {
  for (Eigen::Index row = 0; row < rows.rows(); ++row)
    for (SparseRows::InnerIterator it(rows, row); it; ++it)
      entries.emplace_back(first + int(row), int(it.col()), it.value());
}

}  // namespace

std::vector<ContactCurves> contact_curves(const Scene& scene, const Mesh& mesh) {
  const SideTable table(mesh);
  const SceneNames names(mesh);
  std::map<int, Curve> curves;  // by boundary
  const auto curve_of = [&](int boundary) -> const Curve& {
    const auto at = curves.find(boundary);
    return at != curves.end() ? at->second
                              : curves.emplace(boundary, contact_curve(mesh, boundary, table)).first->second;
  };
  std::vector<ContactCurves> all;
  const std::set<std::pair<int, int>> named = named_pairs(scene, names);
  std::set<std::pair<int, int>> found_before;
  for (const ContactSpec& spec : scene.contacts) {
    auto sides = boundaries_of(spec, names);
    const bool found = is_found(spec);
    std::vector<std::array<int, 2>> pairs{{sides[0][0], sides[1][0]}};
    if (found) {
      for (std::vector<int>& side : sides) {
        std::erase_if(side, [&](int boundary) { return !is_of_one_body(mesh, boundary, table); });
        for (const int boundary : side) curve_of(boundary);
      }
      pairs = facing_pairs(mesh, curves, sides, spec.within);
      if (pairs.empty())
        throw SceneError(spec.key + ".between: no curves '" + spec.between[0] + "' and '" + spec.between[1] +
                         "' of two bodies face each other " +
                         (spec.within ? "within contact.within" : "within half an edge") +
                         "; expected others, or contact.within = a larger distance");
    }
    for (const std::array<int, 2>& pair : pairs) {
      const auto both = std::minmax(pair[0], pair[1]);
      if (found && (named.contains(both) || !found_before.insert(both).second)) continue;
      ContactCurves contact{.spec = spec, .curves = {}};
      contact.spec.found = found;
      for (const int i : {0, 1}) {
        const Curve& curve = contact.curves[i] = curve_of(pair[i]);
        contact.spec.between[i] = mesh.boundaries[pair[i]].name;
        if (!spec.multipliers_on.empty() && spec.multipliers_on == spec.between[i])
          contact.spec.multipliers_on = contact.spec.between[i];
        contact.edge_size[i] = curve_length(mesh.nodes, curve) / double(curve.edges.size());
      }
      all.push_back(std::move(contact));
    }
  }
  return all;
}

std::vector<ContactPair> couple_pairs(const Method& method, const Mesh& mesh, const Discretisation& d,
                                      std::vector<ContactCurves> contacts, const std::vector<char>& dirichlet) {
  std::vector<ContactPair> pairs;
  if (contacts.empty()) return pairs;
  const Thickness thickness(mesh.nodes, boundary_edges(mesh), bonded_to(mesh, body_points(mesh)));
  int first_row = 0;
  for (ContactCurves& contact : contacts) {
    for (Curve& curve : contact.curves) curve.thickness = thickness.behind(curve);
    const ContactSpec& spec = contact.spec;
    require_own_nodes(mesh, spec, contact.curves);
    const bool second = spec.multipliers_on.empty()
                            ? on_second(method.ddm.scheme, mesh.nodes, contact, d.laws, dirichlet)
                            : spec.multipliers_on == spec.between[1];
    ContactPair pair{.spec = spec,
                     .multiplier = std::move(contact.curves[second ? 1 : 0]),
                     .opposite = std::move(contact.curves[second ? 0 : 1]),
                     .geometry = {},
                     .points = {},
                     .coupling = {},
                     .first_row = first_row};
    pair.spec.multipliers_on = spec.between[second ? 1 : 0];
    pair.geometry = {.multiplier = ContactLine(mesh.nodes, pair.multiplier),
                     .opposite = ContactLine(mesh.nodes, pair.opposite),
                     .normals = method.normals == Normals::curve,
                     .gap = spec.initial_gap != InitialGap::measured,
                     .clearance = spec.clearance,
                     .model = d.model};
    pair.points = contact_points(mesh.nodes, pair.multiplier, pair.opposite, method.integration, pair.geometry);
    pair.coupling = couple(mesh, pair.multiplier, pair.opposite, pair.points, d.system.constraints,
                           {method.multipliers, spec.initial_gap}, pair.geometry);
    first_row += int(pair.coupling.B.rows());
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

bool is_drawn(const ContactPair& pair) { return !pair.multiplier.samples.empty() && !pair.opposite.samples.empty(); }

std::string gap_words(const ContactPair& pair) {
  if (pair.spec.initial_gap == InitialGap::closed) return "closed";
  if (pair.spec.initial_gap == InitialGap::measured) return "of the meshes";
  std::ostringstream words;
  words << (is_drawn(pair) ? "as drawn" : "of curves through the nodes");
  if (pair.spec.clearance != 0) words << " + " << pair.spec.clearance;
  return words.str();
}

std::vector<int> row_nodes(const std::vector<ContactPair>& pairs) {
  std::vector<int> nodes;
  for (const ContactPair& pair : pairs) {
    const std::vector<int> of_pair = row_nodes(pair.coupling);
    nodes.insert(nodes.end(), of_pair.begin(), of_pair.end());
  }
  return nodes;
}

void set_contact(const std::vector<ContactPair>& pairs, SaddlePointSystem& system) {
  int rows = 0;
  for (const ContactPair& pair : pairs) rows += int(pair.coupling.B.rows());
  std::vector<Eigen::Triplet<double>> entries;
  system.g.resize(rows);
  system.row_scale.resize(rows);
  system.unilateral.clear();
  for (const ContactPair& pair : pairs) {
    const Coupling& c = pair.coupling;
    append(c.B, pair.first_row, entries);
    system.g.segment(pair.first_row, c.gap0.size()) = -c.gap0;
    system.row_scale.segment(pair.first_row, c.scale.size()) = c.scale;
    system.unilateral.insert(system.unilateral.end(), c.gap0.size(), pair.spec.condition == Condition::unilateral);
  }
  system.B.resize(rows, system.f.size());
  system.B.setFromTriplets(entries.begin(), entries.end());
}

}  // namespace mortise
