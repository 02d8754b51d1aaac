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
#include "problem/facing_pairs.hpp"
#include "problem/scene_names.hpp"
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

std::array<std::vector<int>, 2> boundaries_of(const ContactSpec& spec, const SceneNames& names) {
  const std::string key = spec.key + ".between";
  return {names.boundaries(key, spec.between[0]), names.boundaries(key, spec.between[1])};
}

// One force, or one overlap, is of one chain.
bool is_whole(const ContactSpec& spec) { return spec.pretension || spec.overlap; }

using Pieces = std::multimap<int, int>;  // of a boundary those that are its pieces

Pieces all_pieces(const Mesh& mesh) {
  Pieces pieces;
  for (int b = 0; b < int(mesh.boundaries.size()); ++b)
    if (const int whole = mesh.boundaries[b].piece_of; whole >= 0) pieces.emplace(whole, b);
  return pieces;
}

// Those of the sides of an entry, in place of a boundary that has some its pieces.
std::array<std::vector<int>, 2> chains_of(const Pieces& pieces, const ContactSpec& spec, const SceneNames& names) {
  std::array<std::vector<int>, 2> sides = boundaries_of(spec, names);
  if (pieces.empty() || is_whole(spec)) return sides;
  for (std::vector<int>& side : sides) {
    std::vector<int> chains;
    for (const int boundary : side) {
      const auto [first, end] = pieces.equal_range(boundary);
      if (first == end) chains.push_back(boundary);
      for (auto piece = first; piece != end; ++piece) chains.push_back(piece->second);
    }
    side = std::move(chains);
  }
  return sides;
}

// A pattern may match those of several bodies, as a support's, and means others.
bool is_of_one_body(const Mesh& mesh, int boundary, const SideTable& table) {
  const std::vector<CellSide> sides = sides_of(mesh, mesh.boundaries[boundary], table);
  return std::ranges::all_of(
      sides, [&](const CellSide& side) { return mesh.cells[side.cell].body == mesh.cells[sides[0].cell].body; });
}

// Those that an entry of their own has, with its settings.
std::set<std::pair<int, int>> named_pairs(const Scene& scene, const Pieces& pieces, const SceneNames& names) {
  std::set<std::pair<int, int>> pairs;
  for (const auto* specs : {&scene.contacts, &scene.ties})
    for (const ContactSpec& spec : *specs) {
      if (is_found(spec)) continue;
      const auto sides = chains_of(pieces, spec, names);
      for (const int one : sides[0])
        for (const int other : sides[1]) pairs.insert(std::minmax(one, other));
    }
  return pairs;
}

double size_of(const Mesh& mesh) { return (mesh.nodes.colwise().maxCoeff() - mesh.nodes.colwise().minCoeff()).norm(); }

std::vector<ContactCurves> curves_of(const Scene& scene, const std::vector<ContactSpec>& specs, const Mesh& mesh) {
  if (specs.empty()) return {};
  const SideTable table(mesh);
  const BodyPoints points = body_points(mesh);
  const std::vector<int> whole = bonded_to(mesh, points);
  const Thickness thickness(mesh.nodes, boundary_edges(mesh), whole);
  const SceneNames names(mesh);
  const Pieces pieces = all_pieces(mesh);
  std::map<int, Curve> curves;  // by boundary
  const auto curve_of = [&](int boundary) -> const Curve& {
    const auto at = curves.find(boundary);
    if (at != curves.end()) return at->second;
    Curve curve = contact_curve(mesh, boundary, table);
    curve.thickness = thickness.behind(curve);
    return curves.emplace(boundary, std::move(curve)).first->second;
  };
  std::vector<ContactCurves> all;
  const std::set<std::pair<int, int>> named = named_pairs(scene, pieces, names);
  std::set<std::pair<int, int>> found_before;
  for (const ContactSpec& spec : specs) {
    auto sides = chains_of(pieces, spec, names);
    const bool by_pattern = is_found(spec), found = by_pattern || sides[0].size() + sides[1].size() > 2;
    if (spec.fluid && found)
      throw SceneError(spec.key + ".fluid: '" + spec.between[0] + "' or '" + spec.between[1] +
                       "' falls into pieces; expected two curves of one piece each");
    std::vector<std::array<int, 2>> pairs{{sides[0][0], sides[1][0]}};
    if (found) {
      for (std::vector<int>& side : sides) {
        std::erase_if(side, [&](int boundary) { return !is_of_one_body(mesh, boundary, table); });
        for (const int boundary : side) curve_of(boundary);
      }
      pairs = facing_pairs(mesh, curves, sides, by_pattern ? spec.within : size_of(mesh));
      if (pairs.empty())
        throw SceneError(spec.key + ".between: no curves '" + spec.between[0] + "' and '" + spec.between[1] +
                         "' of two bodies face each other " +
                         (!by_pattern ? "anywhere; expected others"
                          : spec.within
                              ? "within contact.within; expected others, or a larger distance"
                              : "within half an edge; expected others, or contact.within = a larger distance"));
    }
    for (const std::array<int, 2>& pair : pairs) {
      const auto both = std::minmax(pair[0], pair[1]);
      if (found && ((by_pattern && named.contains(both)) || !found_before.insert(both).second)) continue;
      ContactCurves contact{.spec = spec, .curves = {}};
      contact.spec.found = found;
      for (const int i : {0, 1}) {
        const Curve& curve = contact.curves[i] = curve_of(pair[i]);
        contact.spec.between[i] = mesh.boundaries[pair[i]].name;
        if (!spec.multipliers_on.empty() && spec.multipliers_on == spec.between[i])
          contact.spec.multipliers_on = contact.spec.between[i];
        contact.edge_size[i] = curve_length(mesh.nodes, curve) / double(curve.edges.size());
      }
      if (auto& [one, other] = contact.curves; whole[one.body] == whole[other.body]) {
        one.thickness = thickness.behind(one, &other);
        other.thickness = thickness.behind(other, &one);
      }
      require_own_nodes(mesh, points, contact.spec, contact.curves);
      require_two_bodies(mesh, contact.spec, contact.curves);
      all.push_back(std::move(contact));
    }
  }
  return all;
}

}  // namespace

void add_pieces(const Scene& scene, Mesh& mesh) {
  const SceneNames names(mesh);
  std::set<int> in_contact;
  for (const auto* specs : {&scene.contacts, &scene.ties})
    for (const ContactSpec& spec : *specs) {
      if (is_whole(spec)) continue;
      for (const std::vector<int>& side : boundaries_of(spec, names)) in_contact.insert(side.begin(), side.end());
    }
  for (const Boundary& boundary : mesh.boundaries) in_contact.erase(boundary.piece_of);  // that has them
  std::map<int, std::vector<std::vector<int>>> found;
  for (const int whole : in_contact)
    if (auto pieces = pieces_of(mesh, whole); pieces.size() > 1) found.emplace(whole, std::move(pieces));
  if (found.empty()) return;
  const SideTable table(mesh);
  const std::vector<std::string> known = boundary_names(mesh);
  for (const auto& [whole, pieces] : found) {
    if (!is_of_one_body(mesh, whole, table)) continue;
    int number = 0;
    for (const std::vector<int>& edges : pieces) {
      Boundary piece{.name = {}, .edges = {}};
      const Boundary& of = mesh.boundaries[whole];
      do piece.name = of.name + "_" + std::to_string(++number);
      while (std::ranges::find(known, piece.name) != known.end());
      for (const int e : edges) {
        piece.edges.push_back(of.edges[e]);
        if (!of.samples.empty()) piece.samples.push_back(of.samples[e]);
      }
      piece.undrawn = of.undrawn;
      piece.piece_of = whole;
      mesh.boundaries.push_back(std::move(piece));
    }
  }
}

std::vector<ContactCurves> contact_curves(const Scene& scene, const Mesh& mesh) {
  return curves_of(scene, scene.contacts, mesh);
}

std::vector<ContactCurves> tied_curves(const Scene& scene, const Mesh& mesh) {
  return curves_of(scene, scene.ties, mesh);
}

}  // namespace mortise
