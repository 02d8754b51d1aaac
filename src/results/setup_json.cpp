#include "results/setup_json.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include "base/errors.hpp"
#include "base/vectors.hpp"
#include "mesh/boundary_edges.hpp"
#include "results/report.hpp"

namespace mortise {
namespace {

// Corners and middles in turn, counter-clockwise.
Json round(const Cell& cell) {
  Json nodes = Json::array();
  for (int side = 0; side < corner_count(cell.kind); ++side) {
    const Edge edge = side_edge(cell, side);
    nodes.push_back(edge.nodes[0]);
    if (edge.node_count == 3) nodes.push_back(edge.nodes[2]);
  }
  return nodes;
}

Json nodes_json(const Mesh& mesh) {
  Json nodes = Json::array();
  for (const auto& node : mesh.nodes.rowwise()) nodes.push_back(node);
  return nodes;
}

Json bodies_json(const Mesh& mesh) {
  Json bodies = Json::array();
  for (const std::string& name : mesh.bodies) bodies.push_back({{"name", name}, {"cells", Json::array()}});
  for (const Cell& cell : mesh.cells) bodies[std::size_t(cell.body)]["cells"].push_back(round(cell));
  return bodies;
}

// From the edge's start to its end as it is drawn; empty where that is straight.
Json drawn_places(const EdgeSamples& samples) {
  std::vector<Vec2> places;
  for (const SamplePiece& piece : samples.pieces) places.insert(places.end(), piece.places.begin(), piece.places.end());
  const Vec2 chord = places.back() - places.front();
  const auto is_on_chord = [&](const Vec2& x) {
    return std::abs(cross(chord, x - places.front())) <= 1e-9 * chord.squaredNorm();
  };
  return std::ranges::all_of(places, is_on_chord) ? Json::array() : Json(places);
}

using DrawnEdges = std::map<std::array<int, 2>, Json>;  // by their ends, both ways

DrawnEdges drawn_edges(const Boundary& boundary) {
  DrawnEdges drawn;
  for (std::size_t e = 0; e < boundary.samples.size(); ++e) {
    const auto& [start, end, middle] = boundary.edges[e].nodes;
    drawn[{start, end}] = drawn_places(boundary.samples[e]);
    drawn[{end, start}] = drawn_places(reversed(boundary.samples[e]));
  }
  return drawn;
}

Json curves_json(const Mesh& mesh) {
  Json curves = Json::object();
  const BoundaryEdges all = boundary_edges(mesh);
  const std::vector<std::vector<int>> names = names_of(mesh, all.edges);
  std::vector<DrawnEdges> drawn;
  for (const Boundary& boundary : mesh.boundaries) drawn.push_back(drawn_edges(boundary));
  for (std::size_t e = 0; e < all.edges.size(); ++e)
    for (const int b : names[e]) {
      const auto& [start, end, middle] = all.edges[e].edge.nodes;
      curves[mesh.boundaries[std::size_t(b)].name].push_back(
          {start, end, middle, all.edges[e].body, drawn[std::size_t(b)][{start, end}]});
    }
  return curves;
}

Json geometry_json(const Mesh& mesh) {
  return {{"source", mesh.source},
          {"nodes", nodes_json(mesh)},
          {"bodies", bodies_json(mesh)},
          {"curves", curves_json(mesh)}};
}

void write_json(const Json& document, const std::filesystem::path& path) {
  std::ofstream file(path);
  file << document;
  file.close();
  if (!file) throw InputError(path.string() + ": cannot be written");
}

// The names of all curves and points that an entry is on.
std::vector<std::string> places_of(const BoundaryEntry& entry, const Mesh& mesh) {
  std::vector<std::string> places;
  for (const NamedBoundary& on : entry.curves) places.push_back(mesh.boundaries[on.boundary].name);
  for (const int point : entry.points) places.push_back(mesh.points[point].name);
  return places;
}

// Entries of the model on boundaries, with the names that stand in the mesh.
Json as_drawn(const Json& entries, const std::vector<std::vector<std::string>>& places) {
  Json drawn = Json::array();
  for (std::size_t i = 0; i < places.size(); ++i) {
    drawn.push_back({{"on", places[i]}, {"words", entries[i]["words"]}});
    if (entries[i].contains("sum")) drawn.back()["sum"] = entries[i]["sum"];
  }
  return drawn;
}

Json points_json(const Mesh& mesh, const std::set<std::string>& named) {
  Json points = Json::object();
  for (const NamedPoint& point : mesh.points)
    if (named.count(point.name)) points[point.name] = point.nodes;
  return points;
}

}  // namespace

void write_setup(const Problem& p, const std::filesystem::path& path) {
  const Mesh& mesh = p.mesh;
  const Entries& entries = p.entries;
  std::set<std::string> points;
  std::vector<std::vector<std::string>> places_of_supports, places_of_loads;
  Json contact = Json::array(), ties = Json::array(), rest = Json::array();
  for (const BoundaryEntry& entry : entries.boundaries) {
    const std::vector<std::string> on = places_of(entry, mesh);
    points.insert(on.begin(), on.end());
    (is_load(entry.spec.what) ? places_of_loads : places_of_supports).push_back(on);
  }
  const Json model = model_report(p);
  const Json supports = as_drawn(model["supports"], places_of_supports),
             loads = as_drawn(model["loads"], places_of_loads);
  for (const ContactPair& pair : p.pairs) {
    contact.push_back({{"between", pair.spec.between},
                       {"words", to_string(pair.spec.condition) + ", gap " + gap_words(pair) + ", multipliers on " +
                                     pair.spec.multipliers_on}});
  }
  for (const Tie& tie : mesh.ties) ties.push_back(tie.curves);
  for (const Json& tie : model.value("ties", Json::array()))
    for (const std::string what : {"pretension", "overlap"})
      if (tie.contains(what))
        rest.push_back(what + " " + tie[what].dump() + " across " + tie["follows"].get<std::string>());
  if (entries.gravity) rest.push_back("gravity");
  if (!entries.body_forces.empty()) rest.push_back("forces per volume");
  if (!entries.initial_strains.empty()) rest.push_back("initial strains");
  Json setup = geometry_json(mesh);
  for (const Boundary& piece : mesh.boundaries)  // in contact by its pieces alone
    if (piece.piece_of >= 0 && !points.contains(mesh.boundaries[piece.piece_of].name))
      setup["curves"].erase(mesh.boundaries[piece.piece_of].name);
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b)
    setup["bodies"][b]["material"] = entries.bodies[entries.body_of[b]].material;
  setup.update({{"title", p.title},
                {"points", points_json(mesh, points)},
                {"supports", supports},
                {"loads", loads},
                {"contact", contact},
                {"ties", ties},
                {"rest", rest}});
  write_json(setup, path);
}

void write_geometry(const Mesh& mesh, const std::filesystem::path& path) { write_json(geometry_json(mesh), path); }

}  // namespace mortise
