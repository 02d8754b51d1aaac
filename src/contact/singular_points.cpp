#include "contact/singular_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "contact/segments.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

constexpr double degree = std::numbers::pi / 180, straight = std::numbers::pi, tolerance = 20 * degree,
                 clamped_limit = 60 * degree;

// A vertex of a curve and the edges before and after it, -1 at an end.
struct Vertex {
  int node, before, after;
};

std::vector<Vertex> vertices_of(const Curve& curve) {
  const int count = int(curve.edges.size());
  std::vector<Vertex> list;
  for (int e = 0; e < count; ++e)
    list.push_back({curve.edges[e].nodes[0], e > 0 ? e - 1 : curve.closed ? count - 1 : -1, e});
  if (!curve.closed) list.push_back({curve.edges.back().nodes[1], count - 1, -1});
  return list;
}

double turn(const Vec2& from, const Vec2& to) {
  return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

// Interior angle of the material at each vertex of both curves: the sum of the cells' angles there.
std::unordered_map<int, double> interior_angles(const Mesh& mesh, const Curve& first, const Curve& second) {
  std::vector<char> wanted(mesh.nodes.rows(), 0);
  for (const Curve* curve : {&first, &second})
    for (const Edge& edge : curve->edges) wanted[edge.nodes[0]] = wanted[edge.nodes[1]] = 1;
  std::unordered_map<int, double> angles;
  for (const Cell& cell : mesh.cells) {
    const int corners = corner_count(cell.kind);
    for (int i = 0; i < corners; ++i) {
      if (!wanted[cell.nodes[i]]) continue;
      const Vec2 out = edge_point(mesh.nodes, side_edge(cell, i), -1).tangent,
                 in = edge_point(mesh.nodes, side_edge(cell, (i + corners - 1) % corners), 1).tangent;
      angles[cell.nodes[i]] += straight - turn(in, out);
    }
  }
  return angles;
}

// What a body is at a point of its contact line.
struct Corner {
  double angle;          // interior; with its mirror image on a symmetry plane
  bool clamped = false;  // beside a face that cannot move
  bool is_straight() const { return std::abs(angle - straight) <= tolerance; }
};

Corner corner_at(const Vertex& v, const std::unordered_map<int, double>& angles, const Constraints& constraints) {
  const double angle = angles.at(v.node);
  const bool end = v.before < 0 || v.after < 0;
  const int fixed = end ? constraints.fixed[2 * v.node] + constraints.fixed[2 * v.node + 1] : 0;
  if (fixed == 1 && 2 * angle <= 2 * straight + tolerance) return {2 * angle};
  return {angle, fixed == 2};
}

double edges_at(const Points& nodes, const Curve& curve, const Vertex& v) {
  double length = 0;
  for (const int e : {v.before, v.after})
    if (e >= 0) length = std::max(length, edge_length(nodes, curve.edges[e]));
  return length;
}

Vec2 normal_at(const Points& nodes, const Curve& curve, const Vertex& v) {
  Vec2 n = Vec2::Zero();
  if (v.before >= 0) n += edge_point(nodes, curve.edges[v.before], 1).normal();
  if (v.after >= 0) n += edge_point(nodes, curve.edges[v.after], -1).normal();
  return n.normalized();
}

// The body on the other side of a vertex, and its edge there; nothing if it faces none.
struct Facing {
  Corner corner;
  double edge;
};

std::optional<Facing> facing(const Mesh& mesh, const Line& line, double edge, const Curve& other,
                             const std::unordered_map<int, double>& angles, const Constraints& constraints) {
  for (const Vertex& v : vertices_of(other))
    if ((mesh.nodes.row(v.node).transpose() - line.x).norm() < 0.05 * edge)
      return Facing{corner_at(v, angles, constraints), edges_at(mesh.nodes, other, v)};
  const auto hit = project_onto_curve(mesh.nodes, other, line);
  if (!hit) return {};
  return Facing{{straight}, edge_length(mesh.nodes, other.edges[hit->edge])};
}

bool is_singular(const Corner& a, const Corner& b) {
  if (a.is_straight() && b.is_straight()) return false;
  for (const Corner& c : {a, b})
    if (c.clamped && c.angle > clamped_limit) return true;
  return a.angle + b.angle > straight + tolerance;
}

}  // namespace

std::vector<SingularPoint> singular_points(const Mesh& mesh, const Curve& first, const Curve& second,
                                           const Constraints& constraints) {
  const auto angles = interior_angles(mesh, first, second);
  std::vector<SingularPoint> points;
  for (const auto& [curve, other] : {std::pair{&first, &second}, std::pair{&second, &first}})
    for (const Vertex& v : vertices_of(*curve)) {
      const Corner corner = corner_at(v, angles, constraints);
      if (corner.is_straight()) continue;
      const Vec2 x = mesh.nodes.row(v.node).transpose();
      const double edge = edges_at(mesh.nodes, *curve, v);
      const Line line{x, normal_at(mesh.nodes, *curve, v), deepest_overlap(*curve, std::max(v.before, v.after))};
      const auto opposite = facing(mesh, line, edge, *other, angles, constraints);
      if (opposite && is_singular(corner, opposite->corner)) points.push_back({x, std::max(edge, opposite->edge)});
    }
  return points;
}

}  // namespace mortise
