#include "problem/contact_curves.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <span>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "base/union_find.hpp"
#include "fem/edges.hpp"
#include "mesh/body_points.hpp"
#include "mesh/thickness.hpp"
#include "model/patterns.hpp"
#include "problem/curve_pieces.hpp"
#include "problem/facing_pairs.hpp"
#include "scene/scene.hpp"

namespace mortise {
namespace {

// Whether two bodies share more than a point, or are one.
bool bonded(const BodyPoints& points, int one, int other) {
  const auto nodes = [&](int body) {
    return std::span(points.node).subspan(points.first[body], points.first[body + 1] - points.first[body]);
  };
  std::vector<int> common;
  std::ranges::set_intersection(nodes(one), nodes(other), std::back_inserter(common));
  return common.size() > 1;
}

// But for the tip of a crack, which ends both faces.
void require_own_nodes(const Mesh& mesh, const BodyPoints& points, const ContactSpec& spec,
                       const std::array<Curve, 2>& curves) {
  std::vector<int> first = curve_nodes(curves[0]);
  std::ranges::sort(first);
  for (const int node : curve_nodes(curves[1]))
    if (std::ranges::binary_search(first, node) &&
        !(is_end(curves[0], node) && is_end(curves[1], node) && bonded(points, curves[0].body, curves[1].body)))
      throw InputError(mesh.source + ": " + spec.key + ": '" + spec.between[0] + "' and '" + spec.between[1] +
                       "' have a common node " + near_point(mesh.nodes.row(node).transpose()) +
                       "; expected curves with points of their own (in a .geo: a point and a curve for each body)");
}

// Nodes that cells hang together, whatever their bodies, by the smallest of them.
bool hang_together(const Mesh& mesh, int node, int other) {
  UnionFind nodes(std::size_t(mesh.nodes.rows()));
  for (const Cell& cell : mesh.cells)
    for (int a = 1; a < node_count(cell.kind); ++a) nodes.join(cell.nodes[0], cell.nodes[a]);
  return nodes.find(node) == nodes.find(other);
}

// A body is one whole: pieces of it that only contact holds together would be held as one.
void require_two_bodies(const Mesh& mesh, const ContactSpec& spec, const std::array<Curve, 2>& curves) {
  if (curves[0].body != curves[1].body) return;
  if (hang_together(mesh, curves[0].edges[0].nodes[0], curves[1].edges[0].nodes[0])) return;
  throw InputError(mesh.source + ": " + spec.key + ": '" + spec.between[0] + "' and '" + spec.between[1] +
                   "' are curves of two pieces of one body, '" + mesh.bodies[curves[0].body] +
                   "'; expected two bodies (in a .geo: a Physical Surface for each piece)");
}

// Whether the pairs of the entry find themselves.
bool is_found(const ContactSpec& spec) { return is_pattern(spec.between[0]) || is_pattern(spec.between[1]); }

// Curves that are tied, or have no gap whatever is drawn, are drawn as one.
bool is_one_curve(const ContactSpec& spec) {
  return spec.condition == Condition::tied || spec.initial_gap == InitialGap::closed;
}

Nearness nearness(const ContactSpec& spec) { return {.within = spec.within, .as_one_curve = is_one_curve(spec)}; }

using BoundaryPair = std::pair<int, int>;

// Those that an entry of their own has, with its settings.
std::set<BoundaryPair> named_pairs(const Scene& scene, const EntrySides& entries) {
  std::set<BoundaryPair> pairs;
  for (const auto* specs : {&scene.contacts, &scene.ties})
    for (const ContactSpec& spec : *specs) {
      if (is_found(spec)) continue;
      const auto sides = entries.of(spec);
      for (const int one : sides[0])
        for (const int other : sides[1]) pairs.insert(std::minmax(one, other));
    }
  return pairs;
}

// Pairs of boundaries, and which of the two has the multipliers: none where the choice is free.
using KnownPairs = std::map<BoundaryPair, std::optional<int>>;

KnownPairs numbers_of(const Mesh& mesh, const std::vector<KnownPair>& known) {
  std::map<std::string, int> numbers;
  for (std::size_t b = 0; b < mesh.boundaries.size(); ++b) numbers.emplace(mesh.boundaries[b].name, int(b));
  KnownPairs pairs;
  for (const auto& [names, first_is_multiplier] : known)
    if (const auto one = numbers.find(names[0]), other = numbers.find(names[1]);
        one != numbers.end() && other != numbers.end())
      pairs.emplace(std::minmax(one->second, other->second),
                    first_is_multiplier ? std::optional(one->second) : std::nullopt);
  return pairs;
}

double size_of(const Mesh& mesh) { return (mesh.nodes.colwise().maxCoeff() - mesh.nodes.colwise().minCoeff()).norm(); }

// The pairs of curves that entries are, in their order.
class PairFinder {
 public:
  PairFinder(const Scene& scene, const Mesh& mesh, const std::vector<KnownPair>& known)
      : mesh_(mesh),
        seeks_accuracy_(scene.accuracy),
        entries_(mesh),
        named_(named_pairs(scene, entries_)),
        known_(numbers_of(mesh, known)) {}

  void add(const ContactSpec& spec, std::vector<ContactCurves>& all) {
    auto sides = entries_.of(spec);
    const bool by_pattern = is_found(spec), found = by_pattern || sides[0].size() + sides[1].size() > 2;
    if (!found) return all.push_back(contact_of(spec, {sides[0][0], sides[1][0]}, false));
    if (spec.fluid)
      throw SceneError(spec.key + ".fluid: '" + spec.between[0] + "' or '" + spec.between[1] +
                       "' falls into pieces; expected two curves of one piece each");
    for (const std::array<int, 2>& pair : facing(spec, std::move(sides), by_pattern)) {
      const BoundaryPair both = std::minmax(pair[0], pair[1]);
      if ((by_pattern && named_.contains(both)) || !found_before_.insert(both).second) continue;
      all.push_back(contact_of(spec, pair, true));
    }
  }

 private:
  const Curve& curve_of(int boundary) {
    const auto at = curves_.find(boundary);
    if (at != curves_.end()) return at->second;
    Curve curve = contact_curve(mesh_, boundary, table_);
    curve.thickness = thickness_.behind(curve);
    curve.outline = thickness_.outline(curve.body);
    return curves_.emplace(boundary, std::move(curve)).first->second;
  }

  std::vector<std::array<int, 2>> facing(const ContactSpec& spec, std::array<std::vector<int>, 2> sides,
                                         bool by_pattern) {
    for (std::vector<int>& side : sides) {
      std::erase_if(side, [&](int boundary) { return !is_of_one_body(mesh_, boundary, table_); });
      for (const int boundary : side) curve_of(boundary);
    }
    auto pairs = facing_pairs(mesh_, curves_, sides, by_pattern ? nearness(spec) : Nearness{size_of(mesh_)});
    if (by_pattern && !known_.empty()) add_known(sides, pairs);
    if (pairs.empty())
      throw SceneError(spec.key + ".between: no curves '" + spec.between[0] + "' and '" + spec.between[1] +
                       "' of two bodies face each other " +
                       (!by_pattern   ? "anywhere; expected others"
                        : spec.within ? "within contact.within; expected others, or a larger distance"
                        : is_one_curve(spec)
                            ? "as near as two meshes of one curve; expected others, or contact.within "
                              "= how far apart they are drawn"
                            : "within half an edge; expected others, or contact.within = a larger distance"));
    return pairs;
  }

  // By the first, then the second, as those that face each other.
  void add_known(const std::array<std::vector<int>, 2>& sides, std::vector<std::array<int, 2>>& pairs) const {
    std::array<std::map<int, std::size_t>, 2> places;
    for (const int side : {0, 1})
      for (std::size_t i = 0; i < sides[side].size(); ++i) places[side].emplace(sides[side][i], i);
    std::set<BoundaryPair> there;
    for (const auto& [first, second] : pairs) there.insert(std::minmax(first, second));
    for (const auto& [pair, multiplier] : known_)
      for (const auto& [first, second] : {pair, BoundaryPair(pair.second, pair.first)})
        if (places[0].contains(first) && places[1].contains(second) && !there.contains(pair) &&
            !facing_pairs(mesh_, curves_, {{{first}, {second}}}, {size_of(mesh_)}).empty()) {
          there.insert(pair);
          pairs.push_back({first, second});
        }
    std::ranges::sort(pairs, {}, [&](const std::array<int, 2>& pair) {
      return std::pair(places[0].at(pair[0]), places[1].at(pair[1]));
    });
  }

  ContactCurves contact_of(const ContactSpec& spec, const std::array<int, 2>& pair, bool found) {
    ContactCurves contact{.spec = spec, .curves = {}, .on_free_mesh = seeks_accuracy_};
    contact.spec.found = found;
    for (const int i : {0, 1}) {
      const Curve& curve = contact.curves[i] = curve_of(pair[i]);
      contact.spec.between[i] = mesh_.boundaries[pair[i]].name;
      if (!spec.multipliers_on.empty() && spec.multipliers_on == spec.between[i])
        contact.spec.multipliers_on = contact.spec.between[i];
      contact.edge_size[i] = curve_length(mesh_.nodes, curve) / double(curve.edges.size());
    }
    if (const auto known = known_.find(std::minmax(pair[0], pair[1]));
        known != known_.end() && known->second && contact.spec.multipliers_on.empty())
      contact.spec.multipliers_on = mesh_.boundaries[*known->second].name;
    if (auto& [one, other] = contact.curves; whole_[one.body] == whole_[other.body]) {  // faces of one crack
      one.thickness = thickness_.behind(one, &other);
      other.thickness = thickness_.behind(other, &one);
      one.outline = other.outline = nullptr;  // which the other face is a part of
    }
    require_own_nodes(mesh_, points_, contact.spec, contact.curves);
    require_two_bodies(mesh_, contact.spec, contact.curves);
    return contact;
  }

  const Mesh& mesh_;
  const bool seeks_accuracy_;
  const SideTable table_{mesh_};
  const BodyPoints points_ = body_points(mesh_);
  const std::vector<int> whole_ = bonded_to(mesh_, points_);
  const Thickness thickness_{mesh_.nodes, boundary_edges(mesh_), whole_};
  const EntrySides entries_;
  const std::set<BoundaryPair> named_;
  const KnownPairs known_;
  std::set<BoundaryPair> found_before_;
  std::map<int, Curve> curves_;  // by boundary
};

std::vector<ContactCurves> curves_of(const Scene& scene, const std::vector<ContactSpec>& specs, const Mesh& mesh,
                                     const std::vector<KnownPair>& known) {
  std::vector<ContactCurves> all;
  if (specs.empty()) return all;
  PairFinder finder(scene, mesh, known);
  for (const ContactSpec& spec : specs) finder.add(spec, all);
  return all;
}

}  // namespace

std::vector<ContactCurves> contact_curves(const Scene& scene, const Mesh& mesh) {
  return curves_of(scene, scene.contacts, mesh, mesh.known_pairs);
}

std::vector<ContactCurves> tied_curves(const Scene& scene, const Mesh& mesh) {
  return curves_of(scene, scene.ties, mesh, {});
}

std::vector<PatternSides> patterns_without_distance(const Scene& scene, const Mesh& mesh) {
  std::vector<PatternSides> all;
  std::optional<EntrySides> entries;
  for (const ContactSpec& spec : scene.contacts) {
    if (!is_found(spec) || spec.within || is_one_curve(spec)) continue;
    if (!entries) entries.emplace(mesh);
    for (std::vector<int>& side : all.emplace_back(entries->of(spec))) std::ranges::sort(side);
  }
  return all;
}

}  // namespace mortise
