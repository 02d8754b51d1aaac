#include "results/contact_nodes.hpp"

#include <algorithm>
#include <limits>

#include "base/parallel.hpp"
#include "contact/contact_places.hpp"
#include "fem/edges.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

// An end on a symmetry plane continues as its mirror image: the mean normal vanishes along what is prescribed.
Vec2 mirrored(const Vec2& n, const Constraints& constraints, int node) {
  Vec2 m = n;
  for (const Vec2& d : prescribed_directions(constraints, node)) m -= m.dot(d) * d;
  return m.norm() > 1e-3 ? m.normalized() : n;
}

// What each faces is left open. `line`: whose normals are taken instead of the edges'.
CurveNodes nodes_along(const Mesh& mesh, const Curve& curve, const Constraints& constraints, const ContactLine* line) {
  const auto normal_at = [&](int e, double xi) {
    return line ? line->at(e, xi).normal() : edge_point(mesh.nodes, curve.edges[e], xi).normal();
  };
  CurveNodes found;
  const auto add = [&](int node, double s, const Place& place, const Vec2& n) {
    found.nodes.push_back({.node = node, .s = s, .place = place, .own_normal = n, .normal = n});
  };
  double s = 0;
  for (int e = 0; e < int(curve.edges.size()); ++e) {
    const Edge& edge = curve.edges[e];
    const Vec2 n = normal_at(e, -1);
    if (e == 0)
      add(edge.nodes[0], s, {e, -1}, n);
    else
      found.nodes.back().own_normal = (found.nodes.back().own_normal + n).normalized();
    const double length = edge_length(mesh.nodes, edge), before = length_to(mesh.nodes, edge, 0);
    const EdgePoint middle = edge_point(mesh.nodes, edge, 0);
    found.middles.push_back({s + before, middle.position, middle.normal()});
    if (edge.node_count == 3) add(edge.nodes[2], s + before, {e, 0}, normal_at(e, 0));
    s += length;
    add(edge.nodes[1], s, {e, 1}, normal_at(e, 1));
  }
  found.length = s;
  FacingNode &first = found.nodes.front(), &last = found.nodes.back();
  if (curve.closed) {
    first.own_normal = (first.own_normal + last.own_normal).normalized();
    found.nodes.pop_back();
  } else {
    for (FacingNode* end : {&first, &last}) end->own_normal = mirrored(end->own_normal, constraints, end->node);
  }
  return found;
}

// Where the multiplier side's normal passes through a node of the opposite side, near its nearest node there. `edge`:
// the length of the node's own.
std::optional<Place> foot_of(const Mesh& mesh, const Curve& multiplier, const std::vector<FacingNode>& along,
                             const Vec2& x, double edge) {
  const auto nearest = std::ranges::min_element(
      along, {}, [&](const FacingNode& a) { return (mesh.nodes.row(a.node).transpose() - x).squaredNorm(); });
  std::optional<Place> best;
  double distance = std::numeric_limits<double>::infinity();
  const int count = int(multiplier.edges.size());
  for (int step = -1; step <= 1; ++step) {
    int e = nearest->place.edge + step;
    if (multiplier.closed) e = (e + count) % count;
    if (e < 0 || e >= count) continue;
    const auto xi = foot_on_edge(mesh.nodes, multiplier.edges[e], x);
    if (!xi) continue;
    const double d = (edge_point(mesh.nodes, multiplier.edges[e], *xi).position - x).norm();
    if (d < distance) {
      distance = d;
      best = Place{e, *xi};
    }
  }
  // Between two edges' normals, or at the very node: the node itself, unless it lies off to the side; past an end, by
  // more than tells places apart.
  const Vec2 away = x - mesh.nodes.row(nearest->node).transpose();
  const double sideways = std::abs(away.x() * nearest->own_normal.y() - away.y() * nearest->own_normal.x());
  const double size = edge_length(mesh.nodes, multiplier.edges[nearest->place.edge]);
  const double near = is_end(multiplier, nearest->node) ? at_one_place * std::min(size, edge) : 0.1 * size;
  if (away.norm() < distance && sideways < near) best = nearest->place;
  return best;
}

// An end that sticks out past the other side by less than tells places apart faces its end.
void face_from_multiplier_side(const Mesh& mesh, const ContactPair& pair, FacingNode& node) {
  node.normal = node.own_normal;
  node.on_multiplier = node.place;
  const Edge& edge = pair.multiplier.edges[node.place.edge];
  const auto face = [&](double xi) {
    const Line line{edge_point(mesh.nodes, edge, xi).position, node.normal,
                    deepest_overlap(pair.multiplier, node.place.edge)};
    if (const auto hit = project_onto_curve(mesh.nodes, pair.opposite, line)) node.faces = {line, *hit};
  };
  face(node.place.xi);
  if (!node.faces && is_end(pair.multiplier, node.node)) face(node.place.xi * (1 - 2 * at_one_place));
}

// Whether the line meets the opposite side there first: not behind the body that another part of that side, nearer to
// the line's origin, bounds, nor at the back of one.
bool seen_along(const Points& nodes, const Curve& opposite, const FacingNode& node, const Line& line, const Hit& own) {
  if (node.own_normal.dot(line.n) >= 0) return false;
  if (-own.distance > std::min(line.depth, deepest_overlap(opposite, own.edge))) return false;
  const auto first = project_onto_curve(nodes, opposite, line);
  // Beside the node, as between two edges' normals or those of lines, the line meets the same face of that body.
  return !first || std::abs(own.distance) - std::abs(first->distance) <= deepest_overlap(opposite, first->edge);
}

// `along`: the nodes of the multiplier side.
void face_from_opposite_side(const Mesh& mesh, const ContactPair& pair, const std::vector<FacingNode>& along,
                             FacingNode& node) {
  const Points& nodes = mesh.nodes;
  const Vec2 x = nodes.row(node.node).transpose();
  node.normal = -node.own_normal;
  const double edge = edge_length(nodes, pair.opposite.edges[node.place.edge]);
  const auto foot = foot_of(mesh, pair.multiplier, along, x, edge);
  if (!foot) return;
  const Line line = pair.geometry.line_from(nodes, pair.multiplier, *foot);
  // At a vertex of the multiplier side its mean normal, as in that side's own rows.
  const double same = 1e-9 * edge_length(nodes, pair.multiplier.edges[foot->edge]);
  const auto vertex = std::ranges::find_if(
      along, [&](const FacingNode& c) { return (nodes.row(c.node).transpose() - line.x).norm() < same; });
  const Vec2 n = vertex != along.end() ? vertex->normal : line.n;
  const Line out{line.x, n, line.depth};
  const Hit own{node.place.edge, node.place.xi, (x - line.x).dot(n)};
  if (!seen_along(nodes, pair.opposite, node, out, own)) return;
  node.normal = n;
  node.on_multiplier = *foot;
  node.faces = {out, own};
}

ContactNodes nodes_of(const Problem& problem, const ContactPair& pair) {
  const Mesh& mesh = problem.mesh;
  const Constraints& constraints = problem.discretisation.system.constraints;
  const ContactGeometry& geometry = pair.geometry;
  const auto along = [&](const Curve& curve, const std::optional<ContactLine>& line) {
    return nodes_along(mesh, curve, constraints, geometry.normals ? &*line : nullptr);
  };
  ContactNodes found{along(pair.multiplier, geometry.multiplier), along(pair.opposite, geometry.opposite)};
  for (FacingNode& node : found.multiplier.nodes) face_from_multiplier_side(mesh, pair, node);
  for (FacingNode& node : found.opposite.nodes) face_from_opposite_side(mesh, pair, found.multiplier.nodes, node);
  return found;
}

}  // namespace

std::vector<ContactNodes> contact_nodes(const Problem& problem) {
  std::vector<ContactNodes> found(problem.pairs.size());
  for_each_index(found.size(), solver_threads(),
                 [&](std::size_t k) { found[k] = nodes_of(problem, problem.pairs[k]); });
  return found;
}

}  // namespace mortise
