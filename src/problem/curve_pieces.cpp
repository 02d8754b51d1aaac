#include "problem/curve_pieces.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "mesh/curve.hpp"
#include "scene/scene.hpp"

namespace mortise {
namespace {

// One force, or one overlap, is of one chain.
bool is_whole(const ContactSpec& spec) { return spec.pretension || spec.overlap; }

std::array<std::vector<int>, 2> boundaries_of(const ContactSpec& spec, const SceneNames& names) {
  const std::string key = spec.key + ".between";
  return {names.boundaries(key, spec.between[0]), names.boundaries(key, spec.between[1])};
}

// In contact, and without pieces as yet.
std::set<int> boundaries_in_contact(const Scene& scene, const Mesh& mesh) {
  const SceneNames names(mesh);
  std::set<int> found;
  for (const auto* specs : {&scene.contacts, &scene.ties})
    for (const ContactSpec& spec : *specs) {
      if (is_whole(spec)) continue;
      for (const std::vector<int>& side : boundaries_of(spec, names)) found.insert(side.begin(), side.end());
    }
  for (const Boundary& boundary : mesh.boundaries) found.erase(boundary.piece_of);
  return found;
}

// Of a boundary the edges by number.
Boundary piece_of(const Mesh& mesh, int whole, const std::vector<int>& edges, std::string name) {
  const Boundary& of = mesh.boundaries[whole];
  Boundary piece{.name = std::move(name), .edges = {}};
  for (const int e : edges) {
    piece.edges.push_back(of.edges[e]);
    if (!of.samples.empty()) piece.samples.push_back(of.samples[e]);
  }
  piece.undrawn = of.undrawn;
  piece.piece_of = whole;
  return piece;
}

}  // namespace

void add_pieces(const Scene& scene, Mesh& mesh) {
  std::map<int, std::vector<std::vector<int>>> found;
  for (const int whole : boundaries_in_contact(scene, mesh))
    if (auto pieces = pieces_of(mesh, whole); pieces.size() > 1) found.emplace(whole, std::move(pieces));
  if (found.empty()) return;
  const SideTable table(mesh);
  const std::vector<std::string> known = boundary_names(mesh);
  for (const auto& [whole, pieces] : found) {
    if (!is_of_one_body(mesh, whole, table)) continue;
    int number = 0;
    for (const std::vector<int>& edges : pieces) {
      std::string name;
      do name = mesh.boundaries[whole].name + "_" + std::to_string(++number);
      while (std::ranges::find(known, name) != known.end());
      mesh.boundaries.push_back(piece_of(mesh, whole, edges, std::move(name)));
    }
  }
}

EntrySides::EntrySides(const Mesh& mesh) : names_(mesh) {
  for (int b = 0; b < int(mesh.boundaries.size()); ++b)
    if (const int whole = mesh.boundaries[b].piece_of; whole >= 0) pieces_.emplace(whole, b);
}

std::array<std::vector<int>, 2> EntrySides::of(const ContactSpec& spec) const {
  std::array<std::vector<int>, 2> sides = boundaries_of(spec, names_);
  if (pieces_.empty() || is_whole(spec)) return sides;
  for (std::vector<int>& side : sides) {
    std::vector<int> chains;
    for (const int boundary : side) {
      const auto [first, end] = pieces_.equal_range(boundary);
      if (first == end) chains.push_back(boundary);
      for (auto piece = first; piece != end; ++piece) chains.push_back(piece->second);
    }
    side = std::move(chains);
  }
  return sides;
}

bool is_of_one_body(const Mesh& mesh, int boundary, const SideTable& table) {
  const std::vector<CellSide> sides = sides_of(mesh, mesh.boundaries[boundary], table);
  return std::ranges::all_of(
      sides, [&](const CellSide& side) { return mesh.cells[side.cell].body == mesh.cells[sides[0].cell].body; });
}

}  // namespace mortise
