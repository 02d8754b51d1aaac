#include "problem/contact_pair.hpp"

#include <algorithm>
#include <sstream>
#include <tuple>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "base/printable.hpp"
#include "base/vectors.hpp"
#include "contact/curvature_jumps.hpp"
#include "contact/gap_resolution.hpp"
#include "contact/surface_layer.hpp"
#include "fem/edges.hpp"
#include "model/patterns.hpp"
#include "problem/facing_pairs.hpp"
#include "problem/scene_names.hpp"
#include "solve/threads.hpp"

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

// Whether the curve turns at a place on both sides of which it faces the other: contact may go on across it.
bool has_faced_kink(const Points& nodes, const Curve& curve, const ContactLine& line, const Curve& opposite) {
  const int count = int(curve.edges.size());
  const auto faces = [&](int e, double xi) {
    return project_onto_curve(nodes, opposite, line_from(nodes, curve, e, xi)).has_value();
  };
  for (int e = curve.closed ? 0 : 1; e < count; ++e) {
    const int before = (e + count - 1) % count;
    if (angle_between(line.at(before, 1).tangent, line.at(e, -1).tangent) > sharpest_joint && faces(before, 1) &&
        faces(e, -1))
      return true;
  }
  return false;
}

bool is_smooth(const Points& nodes, const Curve& curve, const Curve& opposite) {
  const ContactLine line(nodes, curve);
  return curvature_jumps(nodes, curve, line).empty() && !has_faced_kink(nodes, curve, line, opposite);
}

// Whether the other curve ends somewhere as seen from this one, and goes on farther away: p ends within an edge there,
// while on the other's side it ends at a vertex.
bool sees_steps(const Points& nodes, const Curve& curve, const Curve& opposite) {
  ContactInterface seen;
  seen.multiplier = curve;
  seen.opposite = opposite;
  seen.geometry.multiplier = ContactLine(nodes, curve);
  seen.geometry.normals = true;
  const std::vector<Segment> segments = find_segments(nodes, seen);
  return up_to_steps(nodes, seen, segments).size() < segments.size();
}

// True if the multipliers lie on the second curve of a pair, where the scene does not say. On meshes that [accuracy]
// makes the edges of both are alike but for chance; where the curves part p hangs on whose normals count, and one pair
// would differ from mesh to mesh, or two that are alike from one another. Normals of a curve that turns at a place, or
// whose curvature jumps, make p grow without limit there where bodies slide (error/sliding_kinks.hpp), so the other
// curve's count if that is smooth.
bool on_second(Scheme scheme, const Points& nodes, const ContactCurves& contact, const std::vector<ElasticLaw>& laws,
               const std::vector<char>& dirichlet) {
  const auto& [curves, edge_size] = std::tie(contact.curves, contact.edge_size);
  // Equal meshes differ by round-off in their lengths: the first is the multiplier side then. So do those at a limit.
  constexpr double margin = 1e-6;
  const bool second_finer = edge_size[1] < (1 - margin) * edge_size[0],
             first_finer = edge_size[0] < (1 - margin) * edge_size[1];
  if (dirichlet.empty()) {
    const double first = contact_modulus(laws[curves[0].body]), second = contact_modulus(laws[curves[1].body]);
    if (std::max(first, second) > (1 + margin) * stiffer_limit * std::min(first, second)) return second < first;
    if (contact.on_free_mesh)
      if (const bool one = is_smooth(nodes, curves[0], curves[1]); one != is_smooth(nodes, curves[1], curves[0]))
        return !one;
    if (contact.on_free_mesh)
      if (const bool one = sees_steps(nodes, curves[0], curves[1]); one != sees_steps(nodes, curves[1], curves[0]))
        return one;
    if (const int covered = covered_curve(nodes, curves); covered >= 0) return covered == 1;
    if (contact.on_free_mesh) return false;
    const double ratio = std::max(edge_size[0] / edge_size[1], edge_size[1] / edge_size[0]);
    const Curve& coarser = curves[second_finer ? 0 : 1];
    return coarser.edges[0].node_count == 2 && ratio > (1 + margin) * facet_limit ? !second_finer : second_finer;
  }
  if (scheme == Scheme::neumann_dirichlet) return dirichlet[curves[1].body];
  return first_finer;
}

// `contact` is moved from.
ContactPair coupled(const Method& method, const Mesh& mesh, const Discretisation& d, ContactCurves& contact,
                    const std::vector<char>& dirichlet) {
  const ContactSpec& spec = contact.spec;
  const bool second = spec.multipliers_on.empty() ? on_second(method.ddm.scheme, mesh.nodes, contact, d.laws, dirichlet)
                                                  : spec.multipliers_on == spec.between[1];
  ContactPair pair;
  pair.spec = spec;
  pair.multiplier = std::move(contact.curves[second ? 1 : 0]);
  pair.opposite = std::move(contact.curves[second ? 0 : 1]);
  pair.spec.multipliers_on = spec.between[second ? 1 : 0];
  pair.geometry = {.multiplier = ContactLine(mesh.nodes, pair.multiplier),
                   .opposite = ContactLine(mesh.nodes, pair.opposite),
                   .normals = method.normals == Normals::curve,
                   .gap = spec.initial_gap != InitialGap::measured,
                   .given = spec.initial_gap == InitialGap::given ? std::optional(spec.gap) : std::nullopt,
                   .clearance = spec.clearance,
                   .s = {},
                   .model = d.model,
                   .beyond_steps = spec.fluid.has_value()};
  if (spec.gap.uses_arc_length() || spec.clearance.uses_arc_length())
    pair.geometry.s.emplace(mesh.nodes, pair.multiplier);
  pair.points = contact_points(mesh.nodes, pair, method.integration);
  find_one_line(mesh.nodes, pair);
  pair.coupling = told_with_key(spec.key, [&] {
    return couple(mesh, pair, d.system.constraints, {method.multipliers, spec.initial_gap});
  });
  return pair;
}

// The layers of all pairs, one behind another.
SurfaceLayers surface_layers(const std::vector<ContactPair>& pairs, Eigen::Index rows) {
  Triplets B;
  std::vector<double> weight;
  SurfaceLayers layers;
  for (const ContactPair& pair : pairs) {
    if (!pair.spec.stiffness) continue;
    for (const auto& t : surface_layer(pair))
      B.emplace_back(pair.first_row + t.row(), int(weight.size()) + t.col(), t.value());
    for (const ContactPoint& point : pair.points) {
      weight.push_back(point.dA);
      layers.beside.push_back(2 * pair.multiplier.edges[point.edge].nodes[0]);
    }
    layers.laws.push_back({*pair.spec.stiffness, int(weight.size())});
  }
  layers.weight = Eigen::Map<const VecX>(weight.data(), Eigen::Index(weight.size()));
  layers.B = filled(rows, layers.weight.size(), B);
  return layers;
}

}  // namespace

std::vector<ContactPair> couple_pairs(const Method& method, const Mesh& mesh, const Discretisation& d,
                                      std::vector<ContactCurves> contacts, const std::vector<char>& dirichlet) {
  std::vector<ContactPair> pairs(contacts.size());
  for_each_index(pairs.size(), solver_threads(),
                 [&](std::size_t k) { pairs[k] = coupled(method, mesh, d, contacts[k], dirichlet); });
  int first_row = 0;
  for (ContactPair& pair : pairs) {
    pair.first_row = first_row;
    first_row += int(pair.coupling.B.rows());
  }
  return pairs;
}

bool is_drawn(const ContactPair& pair) { return !pair.multiplier.samples.empty() && !pair.opposite.samples.empty(); }

std::string gap_words(const ContactPair& pair) {
  const ContactSpec& spec = pair.spec;
  std::ostringstream more;
  if (spec.stiffness) more << ", " << spec.stiffness->words();
  if (spec.fluid) more << ", fluid at " << spec.fluid->pressure;
  if (spec.initial_gap == InitialGap::closed) return "closed" + more.str();
  if (spec.initial_gap == InitialGap::given) return spec.gap.words() + more.str();
  const std::string of = spec.initial_gap == InitialGap::measured ? "of the meshes"
                         : is_drawn(pair)                         ? "as drawn"
                                                                  : "of curves through the nodes";
  return (spec.clearance == Field() ? of : of + " + " + spec.clearance.words()) + more.str();
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
  Triplets entries;
  system.g.resize(rows);
  system.row_scale.resize(rows);
  system.unilateral.clear();
  for (const ContactPair& pair : pairs) {
    const Coupling& c = pair.coupling;
    for_each_entry(
        c.B, [&](int row, int column, double value) { entries.emplace_back(pair.first_row + row, column, value); });
    system.g.segment(pair.first_row, c.gap0.size()) = -c.gap0;
    system.row_scale.segment(pair.first_row, c.scale.size()) = c.scale;
    system.unilateral.insert(system.unilateral.end(), c.gap0.size(), pair.spec.condition == Condition::unilateral);
  }
  system.B = filled(rows, system.f.size(), entries);
  system.layers = surface_layers(pairs, rows);
}

}  // namespace mortise
