#include "results/setup_json.hpp"

#include <fstream>
#include <set>

#include "base/errors.hpp"
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

Json bodies_json(const Problem& p) {
  Json bodies = Json::array();
  for (std::size_t b = 0; b < p.mesh.bodies.size(); ++b)
    bodies.push_back({{"name", p.mesh.bodies[b]},
                      {"cells", Json::array()},
                      {"material", p.entries.bodies[p.entries.body_of[b]].material}});
  for (const Cell& cell : p.mesh.cells) bodies[std::size_t(cell.body)]["cells"].push_back(round(cell));
  return bodies;
}

Json curves_json(const Mesh& mesh, const std::set<std::string>& named) {
  Json curves = Json::object();
  const BoundaryEdges all = boundary_edges(mesh);
  const std::vector<std::vector<int>> names = names_of(mesh, all.edges);
  for (std::size_t e = 0; e < all.edges.size(); ++e)
    for (const int b : names[e])
      if (const std::string& name = mesh.boundaries[std::size_t(b)].name; named.count(name))
        curves[name].push_back(all.edges[e].edge.nodes);
  return curves;
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
  std::set<std::string> named;
  std::vector<std::vector<std::string>> places_of_supports, places_of_loads;
  Json nodes = Json::array(), contact = Json::array(), ties = Json::array(), rest = Json::array();
  for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) nodes.push_back({mesh.nodes(n, 0), mesh.nodes(n, 1)});
  for (const BoundaryEntry& entry : entries.boundaries) {
    const std::vector<std::string> on = places_of(entry, mesh);
    named.insert(on.begin(), on.end());
    (is_load(entry.spec.what) ? places_of_loads : places_of_supports).push_back(on);
  }
  const Json model = model_report(p);
  const Json supports = as_drawn(model["supports"], places_of_supports),
             loads = as_drawn(model["loads"], places_of_loads);
  for (const ContactPair& pair : p.pairs) {
    named.insert(pair.spec.between.begin(), pair.spec.between.end());
    contact.push_back({{"between", pair.spec.between},
                       {"words", to_string(pair.spec.condition) + ", gap " + gap_words(pair) + ", multipliers on " +
                                     pair.spec.multipliers_on}});
  }
  for (const Tie& tie : mesh.ties) {
    named.insert(tie.curves.begin(), tie.curves.end());
    ties.push_back(tie.curves);
  }
  if (entries.gravity) rest.push_back("gravity");
  if (!entries.body_forces.empty()) rest.push_back("forces per volume");
  if (!entries.initial_strains.empty()) rest.push_back("initial strains");
  std::ofstream file(path);
  file << Json{{"title", p.title},
               {"nodes", nodes},
               {"bodies", bodies_json(p)},
               {"curves", curves_json(mesh, named)},
               {"points", points_json(mesh, named)},
               {"supports", supports},
               {"loads", loads},
               {"contact", contact},
               {"ties", ties},
               {"rest", rest}};
  file.close();
  if (!file) throw InputError(path.string() + ": cannot be written");
}

}  // namespace mortise
