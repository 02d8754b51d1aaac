#include "problem/audited_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "fem/edges.hpp"

namespace mortise {
namespace {

bool has(const std::vector<int>& list, int value) { return std::find(list.begin(), list.end(), value) != list.end(); }

// An edge and those beside it.
std::vector<int> with_neighbours(const Outline& o, int edge) {
  std::vector<int> list{edge};
  for (const int other : o.neighbour[edge])
    if (other >= 0) list.push_back(other);
  return list;
}

// Whether a boundary lies on one body, as a contact curve does.
bool on_one_body(const AuditedBodies& b, int name) {
  int body = -1;
  for (std::size_t e = 0; e < b.names.size(); ++e) {
    if (!has(b.names[e], name)) continue;
    const int of_edge = b.outline.edges[e].body;
    if (body >= 0 && of_edge != body) return false;
    body = of_edge;
  }
  return true;
}

}  // namespace

AuditedBodies audited_bodies(const Mesh& mesh, const std::vector<ContactPair>& pairs) {
  std::vector<std::vector<AuditedBodies::Partner>> partners(mesh.boundaries.size());
  for (const ContactPair& pair : pairs) {
    const Curve &m = pair.multiplier, &o = pair.opposite;
    partners[m.boundary].push_back({o.boundary, o.body});
    partners[o.boundary].push_back({m.boundary, m.body});
  }
  for (const Tie& tie : mesh.ties)
    for (const int k : {0, 1}) partners[tie.boundary[k]].push_back({tie.boundary[1 - k], tie.body[1 - k]});
  BoundaryEdges boundary = boundary_edges(mesh);
  std::vector<std::vector<int>> cells(boundary.pieces);
  for (int c = 0; c < int(mesh.cells.size()); ++c) cells[boundary.piece_of_cell[c]].push_back(c);
  Outline o = outline(boundary, mesh.nodes);
  std::vector<std::vector<int>> names = names_of(mesh, boundary.edges);
  return {mesh, std::move(partners), std::move(cells), std::move(boundary), std::move(o), std::move(names)};
}

bool paired(const AuditedBodies& b, int edge, int other) {
  for (const int name : b.names[edge])
    for (const AuditedBodies::Partner& partner : b.partners[name])
      if (has(b.names[other], partner.boundary)) return true;
  return false;
}

bool nearly_paired(const AuditedBodies& b, int edge, int other) {
  for (const int e : with_neighbours(b.outline, edge))
    for (const int f : with_neighbours(b.outline, other))
      if (paired(b, e, f)) return true;
  return false;
}

bool paired_with_body(const AuditedBodies& b, int edge, int body) {
  for (const int name : b.names[edge])
    for (const AuditedBodies::Partner& partner : b.partners[name])
      if (partner.body == body) return true;
  return false;
}

bool face_each_other(const Vec2& normal, const OutlinePlace& place) {
  return normal.dot(place.normal) < (place.vertex ? -0.8 : -0.7);
}

std::string two_bodies(const Mesh& mesh, int first, int second) {
  if (first == second) return "two pieces of body '" + mesh.bodies[first] + "'";
  return "bodies '" + mesh.bodies[first] + "' and '" + mesh.bodies[second] + "'";
}

int main_name(const AuditedBodies& b, const std::vector<int>& edges) {
  std::map<int, double> lengths;
  double total = 0;
  for (const int e : edges) {
    total += b.outline.length[e];
    for (const int name : b.names[e]) lengths[name] += b.outline.length[e];
  }
  int best = -1;
  double longest = 0;
  for (const auto& [name, length] : lengths) {
    const bool equal = length > (1 - 1e-9) * longest && length < (1 + 1e-9) * longest;
    const bool shorter = best >= 0 && b.mesh.boundaries[name].edges.size() < b.mesh.boundaries[best].edges.size();
    if (equal ? !shorter : length < longest) continue;
    best = name;
    longest = length;
  }
  return longest > total / 3 ? best : -1;
}

std::string name_of(const AuditedBodies& b, const std::vector<int>& edges) {
  const int name = main_name(b, edges);
  return name >= 0 ? "'" + b.mesh.boundaries[name].name + "'"
                   : "an unnamed boundary of '" + b.mesh.bodies[b.outline.edges[edges.front()].body] + "'";
}

std::string advice(const AuditedBodies& b, const std::vector<int>& edges, const std::vector<int>& others) {
  if (b.outline.edges[edges.front()].body == b.outline.edges[others.front()].body)
    return "make them one (in a .geo: BooleanFragments or Coherence), or two bodies with a contact pair";
  const auto name = [&](const std::vector<int>& some) {
    const int found = main_name(b, some);
    return found >= 0 && on_one_body(b, found) ? found : -1;
  };
  const int first = name(edges), second = name(others);
  const auto word = [&](int k) { return k >= 0 ? "\"" + b.mesh.boundaries[k].name + "\"" : "..."; };
  return std::string(first < 0 || second < 0 ? "name the boundaries there as physical curves and write" : "write") +
         " [[contact]] between = [" + word(first) + ", " + word(second) + "]";
}

Vec2 middle_of(const AuditedBodies& b, const std::vector<int>& edges) {
  const auto middle = [&](int e) { return edge_point(b.outline.nodes, b.outline.edges[e].edge, 0).position; };
  Vec2 centre = Vec2::Zero(), best = Vec2::Zero();
  double length = 0, distance = std::numeric_limits<double>::infinity();
  for (const int e : edges) {
    centre += b.outline.length[e] * middle(e);
    length += b.outline.length[e];
  }
  centre /= length;
  for (const int e : edges) {
    const double d = (middle(e) - centre).norm();
    if (d >= (1 - 1e-6) * distance) continue;  // of equals the first
    distance = d;
    best = middle(e);
  }
  for (int c = 0; c < 2; ++c)
    if (std::abs(best(c)) < 1e-9 * length) best(c) = 0;  // no round-off in messages
  return best;
}

}  // namespace mortise
