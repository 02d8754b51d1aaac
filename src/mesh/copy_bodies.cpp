#include "mesh/copy_bodies.hpp"

#include <cmath>
#include <numbers>
#include <unordered_map>
#include <unordered_set>

#include "base/errors.hpp"
#include "base/printable.hpp"

namespace mortise {
namespace {

struct Motion {
  Eigen::Matrix2d turn;
  Vec2 shift;
  Vec2 operator()(const Vec2& x) const { return turn * x + shift; }
};

// Quarter turns are exact.
Motion motion_of(const BodyCopy& copy) {
  int quarters = 0;
  const double rest = std::remquo(copy.degrees, 90, &quarters) * std::numbers::pi / 180;
  const Vec2 quarter[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  const Vec2 q = quarter[quarters & 3], r(std::cos(rest), std::sin(rest));
  const double cosine = q.x() * r.x() - q.y() * r.y(), sine = q.y() * r.x() + q.x() * r.y();
  const Eigen::Matrix2d turn{{cosine, -sine}, {sine, cosine}};
  return {.turn = turn, .shift = copy.centre - turn * copy.centre + copy.shift};
}

// The number of the piece that each body goes to: 0 for those that are not copied.
std::vector<int> pieces_of_bodies(const Mesh& mesh, const std::vector<BodyCopy>& copies) {
  std::unordered_map<std::string, int> numbers;
  for (const std::string& body : mesh.bodies) numbers.emplace(body, int(numbers.size()));
  std::vector<int> piece(mesh.bodies.size(), 0);
  int count = 0;
  for (const BodyCopy& copy : copies) {
    const auto body = numbers.find(copy.body);
    if (body == numbers.end())
      throw SceneError(copy.key + ": " + unknown_name("body", copy.body, mesh.bodies) + " (" + mesh.source + ")");
    if (int& own = piece[body->second]; own == 0) own = ++count;
  }
  return piece;
}

// The body of each node. Throws where a copied one shares nodes with another.
std::vector<int> bodies_of_nodes(const Mesh& mesh, const std::vector<int>& piece, const std::vector<BodyCopy>& copies) {
  std::vector<int> body(mesh.nodes.rows(), -1);
  for (const Cell& cell : mesh.cells)
    for (int i = 0; i < node_count(cell.kind); ++i) {
      int& own = body[cell.nodes[i]];
      if (own >= 0 && piece[own] != piece[cell.body]) {
        const int copied = piece[own] > 0 ? own : cell.body, other = own + cell.body - copied;
        const auto copy = std::ranges::find(copies, mesh.bodies[copied], &BodyCopy::body);
        throw SceneError(copy->key + ": body '" + copy->body + "' shares nodes with '" + mesh.bodies[other] + "' " +
                         near_point(mesh.nodes.row(cell.nodes[i]).transpose()) +
                         "; expected a body with nodes of its own");
      }
      own = cell.body;
    }
  return body;
}

void add_edges(const Boundary& boundary, const std::vector<int>& piece_of_node, const std::vector<int>& number,
               std::vector<Mesh>& pieces) {
  for (std::size_t e = 0; e < boundary.edges.size(); ++e) {
    Edge edge = boundary.edges[e];
    std::vector<Boundary>& own = pieces[piece_of_node[edge.nodes[0]]].boundaries;
    if (own.empty() || own.back().name != boundary.name)
      own.push_back({.name = boundary.name, .edges = {}, .undrawn = boundary.undrawn});
    for (int i = 0; i < edge.node_count; ++i) edge.nodes[i] = number[edge.nodes[i]];
    own.back().edges.push_back(edge);
    if (!boundary.samples.empty()) own.back().samples.push_back(boundary.samples[e]);
  }
}

void add_nodes(const NamedPoint& point, const std::vector<int>& piece_of_node, const std::vector<int>& number,
               std::vector<Mesh>& pieces) {
  for (const int node : point.nodes) {
    std::vector<NamedPoint>& own = pieces[piece_of_node[node]].points;
    if (own.empty() || own.back().name != point.name) own.push_back({point.name, {}});
    own.back().nodes.push_back(number[node]);
  }
}

// The pieces as meshes of their own.
std::vector<Mesh> split(const Mesh& mesh, const std::vector<int>& piece, const std::vector<BodyCopy>& copies) {
  std::vector<Mesh> pieces(*std::ranges::max_element(piece) + 1);
  std::vector<int> own(mesh.bodies.size());
  for (std::size_t b = 0; b < piece.size(); ++b) {
    own[b] = int(pieces[piece[b]].bodies.size());
    pieces[piece[b]].bodies.push_back(mesh.bodies[b]);
  }
  std::vector<int> piece_of_node = bodies_of_nodes(mesh, piece, copies), number(piece_of_node.size());
  std::vector<std::vector<int>> nodes(pieces.size());
  for (std::size_t i = 0; i < number.size(); ++i) {
    piece_of_node[i] = piece[piece_of_node[i]];
    number[i] = int(nodes[piece_of_node[i]].size());
    nodes[piece_of_node[i]].push_back(int(i));
  }
  for (std::size_t k = 0; k < pieces.size(); ++k) pieces[k].nodes = mesh.nodes(nodes[k], Eigen::all);
  for (Cell cell : mesh.cells) {
    for (int i = 0; i < node_count(cell.kind); ++i) cell.nodes[i] = number[cell.nodes[i]];
    Mesh& to = pieces[piece[cell.body]];
    cell.body = own[cell.body];
    to.cells.push_back(cell);
  }
  for (const Boundary& boundary : mesh.boundaries) add_edges(boundary, piece_of_node, number, pieces);
  for (const NamedPoint& point : mesh.points) add_nodes(point, piece_of_node, number, pieces);
  return pieces;
}

std::string name_in_copy(const BodyCopy& copy, const std::string& name) {
  if (name.starts_with(copy.body)) {
    const std::string rest = name.substr(copy.body.size());
    if (rest.empty() || std::string("_-.: ").find(rest.front()) != std::string::npos) return copy.name + rest;
  }
  return copy.name + "_" + name;
}

// Nodes from row `first` on, which is the next.
void append(const Mesh& original, const BodyCopy& copy, int first, Mesh& mesh) {
  const Motion motion = motion_of(copy);
  for (Eigen::Index i = 0; i < original.nodes.rows(); ++i)
    mesh.nodes.row(first + i) = motion(original.nodes.row(i).transpose()).transpose();
  for (Cell cell : original.cells) {
    for (int i = 0; i < node_count(cell.kind); ++i) cell.nodes[i] += first;
    cell.body = int(mesh.bodies.size());
    mesh.cells.push_back(cell);
  }
  mesh.bodies.push_back(copy.name);
  for (Boundary boundary : original.boundaries) {
    boundary.name = name_in_copy(copy, boundary.name);
    for (Edge& edge : boundary.edges)
      for (int i = 0; i < edge.node_count; ++i) edge.nodes[i] += first;
    for (EdgeSamples& samples : boundary.samples)
      for (SamplePiece& piece : samples.pieces)
        for (Vec2& x : piece.places) x = motion(x);
    mesh.boundaries.push_back(std::move(boundary));
  }
  for (NamedPoint point : original.points) {
    point.name = name_in_copy(copy, point.name);
    for (int& node : point.nodes) node += first;
    mesh.points.push_back(std::move(point));
  }
}

// Names of one sort, each taken once.
class Names {
 public:
  explicit Names(std::string sort) : sort_(std::move(sort)) {}
  void take(const std::string& name, const BodyCopy& copy) {
    if (!taken_.insert(name).second)
      throw SceneError(copy.key + ": the copy '" + copy.name + "' of '" + copy.body + "' has a " + sort_ + " '" + name +
                       "', as another has; expected a name of its own");
  }
  void take(const std::string& name) { taken_.insert(name); }

 private:
  std::string sort_;
  std::unordered_set<std::string> taken_;
};

void check_names(const std::vector<Mesh>& pieces, const std::vector<const Mesh*>& originals,
                 const std::vector<BodyCopy>& copies) {
  Names bodies("body"), curves("curve"), points("point");
  for (const std::string& body : pieces[0].bodies) bodies.take(body);
  for (const Boundary& boundary : pieces[0].boundaries) curves.take(boundary.name);
  for (const NamedPoint& point : pieces[0].points) points.take(point.name);
  for (std::size_t k = 0; k < copies.size(); ++k) {
    bodies.take(copies[k].name, copies[k]);
    for (const Boundary& boundary : originals[k]->boundaries)
      curves.take(name_in_copy(copies[k], boundary.name), copies[k]);
    for (const NamedPoint& point : originals[k]->points) points.take(name_in_copy(copies[k], point.name), copies[k]);
  }
}

}  // namespace

Mesh copy_bodies(Mesh mesh, const std::vector<BodyCopy>& copies) {
  if (copies.empty()) return mesh;
  const std::vector<Mesh> pieces = split(mesh, pieces_of_bodies(mesh, copies), copies);
  std::unordered_map<std::string, const Mesh*> by_name;
  for (std::size_t k = 1; k < pieces.size(); ++k) by_name.emplace(pieces[k].bodies[0], &pieces[k]);
  std::vector<const Mesh*> originals;
  Eigen::Index nodes = pieces[0].nodes.rows(), cells = pieces[0].cells.size();
  for (const BodyCopy& copy : copies) {
    originals.push_back(by_name.at(copy.body));
    nodes += originals.back()->nodes.rows();
    cells += originals.back()->cells.size();
  }
  check_names(pieces, originals, copies);
  if (nodes > std::numeric_limits<int>::max() / 2)
    throw SceneError(copies.front().key + ": the copies have " + std::to_string(nodes) + " nodes; expected at most " +
                     std::to_string(std::numeric_limits<int>::max() / 2));

  Mesh all = pieces[0];
  all.source = mesh.source;
  all.notes = mesh.notes;
  all.named_by_tag = mesh.named_by_tag;
  int first = int(all.nodes.rows());
  all.nodes.conservativeResize(nodes, 2);
  all.cells.reserve(cells);
  for (std::size_t k = 0; k < copies.size(); ++k) {
    append(*originals[k], copies[k], first, all);
    first += int(originals[k]->nodes.rows());
  }
  return all;
}

}  // namespace mortise
