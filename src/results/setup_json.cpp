#include "results/setup_json.hpp"

#include <fstream>
#include <set>

#include "base/errors.hpp"
#include "mesh/boundary_edges.hpp"
#include "problem/scene_names.hpp"
#include "results/model_summary.hpp"

namespace mortise {
namespace {

using Json = nlohmann::ordered_json;

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

Json bodies_json(const Scene& scene, const Mesh& mesh) {
  Json bodies = Json::array();
  for (const std::string& name : mesh.bodies) bodies.push_back({{"name", name}, {"cells", Json::array()}});
  for (const Cell& cell : mesh.cells) bodies[std::size_t(cell.body)]["cells"].push_back(round(cell));
  const SceneNames names(mesh);
  for (const BodySpec& spec : scene.bodies)
    for (const int b : names.bodies("bodies", spec.name)) bodies[std::size_t(b)]["material"] = spec.material;
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
std::vector<std::string> places_of(const BoundarySpec& spec, const Mesh& mesh, const SceneNames& names) {
  std::vector<std::string> places;
  for (const std::string& name : spec.on) {
    const SceneNames::Places found = names.places(spec.key, name);
    for (const int b : found.boundaries) places.push_back(mesh.boundaries[std::size_t(b)].name);
    for (const int p : found.points) places.push_back(mesh.points[std::size_t(p)].name);
  }
  return places;
}

Json points_json(const Mesh& mesh, const std::set<std::string>& named) {
  Json points = Json::object();
  for (const NamedPoint& point : mesh.points)
    if (named.count(point.name)) points[point.name] = point.nodes;
  return points;
}

}  // namespace

void write_setup(const Scene& scene, const Mesh& mesh, const Discretisation& d, const std::vector<ContactPair>& pairs,
                 const std::filesystem::path& path) {
  std::set<std::string> named;
  Json nodes = Json::array(), supports = Json::array(), loads = Json::array(), contact = Json::array(),
       ties = Json::array(), rest = Json::array();
  for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) nodes.push_back({mesh.nodes(n, 0), mesh.nodes(n, 1)});
  const SceneNames names(mesh);
  for (std::size_t i = 0; i < scene.boundaries.size(); ++i) {
    const BoundarySpec& spec = scene.boundaries[i];
    const std::vector<std::string> on = places_of(spec, mesh, names);
    named.insert(on.begin(), on.end());
    Json entry{{"on", on}, {"words", boundary_words(spec)}};
    if (spec.is_load()) entry["sum"] = {d.boundary_sums[i].force.x(), d.boundary_sums[i].force.y()};
    (spec.is_load() ? loads : supports).push_back(entry);
  }
  for (const ContactPair& pair : pairs) {
    named.insert(pair.spec.between.begin(), pair.spec.between.end());
    contact.push_back({{"between", pair.spec.between},
                       {"words", to_string(pair.spec.condition) + ", gap " + gap_words(pair) + ", multipliers on " +
                                     pair.spec.multipliers_on}});
  }
  for (const Tie& tie : mesh.ties) {
    named.insert(tie.curves.begin(), tie.curves.end());
    ties.push_back(tie.curves);
  }
  if (scene.gravity) rest.push_back("gravity");
  if (!scene.body_forces.empty()) rest.push_back("forces per volume");
  if (!scene.initial_strains.empty()) rest.push_back("initial strains");
  std::ofstream file(path);
  file << Json{{"title", scene.title},
               {"nodes", nodes},
               {"bodies", bodies_json(scene, mesh)},
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
