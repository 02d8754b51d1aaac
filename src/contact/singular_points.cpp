#include "contact/singular_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vectors.hpp"
#include "contact/projection.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// Curves turn less where they are smooth; what one mesh may miss of the other's kink.
constexpr double degree = std::numbers::pi / 180, straight = std::numbers::pi, smooth = 2 * degree,
                 missed = 20 * degree;

// A vertex of a curve and the edges before and after it, -1 at an end.
struct Vertex {
  int node, before, after;
  bool is_end() const { return before < 0 || after < 0; }
};

std::vector<Vertex> vertices_of(const Curve& curve) {
  const int count = int(curve.edges.size());
  std::vector<Vertex> list;
  for (int e = 0; e < count; ++e)
    list.push_back({curve.edges[e].nodes[0], e > 0 ? e - 1 : curve.closed ? count - 1 : -1, e});
  if (!curve.closed) list.push_back({curve.edges.back().nodes[1], count - 1, -1});
  return list;
}

// The sides of cells that end at a node and have no cell behind them, the body on their left.
std::vector<Edge> outline_at(const Mesh& mesh, const SideTable& table, int node) {
  std::vector<Edge> outline;
  for (const SideAtNode& at : table.at(node))
    if (std::ranges::none_of(table.at(node), [&](const SideAtNode& behind) {
          return behind.other == at.other && behind.starts != at.starts;
        }))
      outline.push_back(side_edge(mesh.cells[at.side.cell], at.side.side));
  return outline;
}

// What holds a face, by what is prescribed at all nodes of its edge.
Face face_of(const Points& nodes, const Edge& edge, const Constraints& constraints) {
  std::optional<Vec2> held;  // the direction in which all nodes are, where none is held in both
  for (int k = 0; k < edge.node_count; ++k) {
    const std::vector<Vec2> directions = prescribed_directions(constraints, edge.nodes[k]);
    if (directions.empty()) return Face::free;
    if (directions.size() == 2) continue;
    if (held && std::abs(cross(*held, directions[0])) > 0.1) return Face::free;
    held = directions[0];
  }
  if (!held) return Face::clamped;
  const Vec2 along = (nodes.row(edge.nodes[1]) - nodes.row(edge.nodes[0])).transpose();
  return std::abs(along.dot(*held)) > std::abs(cross(along, *held)) ? Face::antisymmetric : Face::symmetric;
}

// Of the body on the left where a curve goes on from one tangent to the other.
double interior_angle(const Vec2& before, const Vec2& after) {
  return straight - std::atan2(cross(before, after), before.dot(after));
}

// What a body is at a point of its contact line.
struct Corner {
  Wedge wedge;
  bool end;     // its curve does not go on
  double edge;  // length of the longest one of its curve there
};

// One of the two curves with the line that it stands for.
struct Side {
  const Mesh& mesh;
  const SideTable& table;
  const Curve& curve;
  const Constraints& constraints;
  const ElasticLaw& law;
  ContactLine line;

  Vec2 position(const Vertex& v) const { return mesh.nodes.row(v.node).transpose(); }
  Vec2 before(const Vertex& v) const { return line.at(v.before, 1).tangent; }
  Vec2 after(const Vertex& v) const { return line.at(v.after, -1).tangent; }
  bool is_kink(const Vertex& v) const {
    return !v.is_end() && std::abs(interior_angle(before(v), after(v)) - straight) > smooth;
  }
  double edge_at(const Vertex& v) const {
    double length = 0;
    for (const int e : {v.before, v.after})
      if (e >= 0) length = std::max(length, edge_length(mesh.nodes, curve.edges[e]));
    return length;
  }
  Vec2 normal(const Vertex& v) const {
    Vec2 n = Vec2::Zero();
    if (v.before >= 0) n += line.at(v.before, 1).normal();
    if (v.after >= 0) n += line.at(v.after, -1).normal();
    return n.normalized();
  }
  Corner corner(const Vertex& v) const;
};

Corner Side::corner(const Vertex& v) const {
  if (!v.is_end()) return {wedge(interior_angle(before(v), after(v)), law), false, edge_at(v)};
  for (const Edge& beyond : outline_at(mesh, table, v.node)) {
    const bool starts = beyond.nodes[0] == v.node;
    if (starts != (v.after < 0)) continue;  // the curve's own
    const Vec2 tangent = edge_point(mesh.nodes, beyond, starts ? -1 : 1).tangent;
    const double angle = starts ? interior_angle(before(v), tangent) : interior_angle(tangent, after(v));
    return {wedge(angle, law, face_of(mesh.nodes, beyond, constraints)), true, edge_at(v)};
  }
  return {wedge(straight, law), true, edge_at(v)};
}

// The body on the other side of a vertex; nothing if it is half an edge away or more.
std::optional<Corner> facing(const Side& side, const Vertex& v, const Side& other) {
  const Vec2 x = side.position(v);
  const double edge = side.edge_at(v);
  for (const Vertex& w : vertices_of(other.curve))
    if ((other.position(w) - x).norm() < 0.05 * edge) return other.corner(w);
  const Line line{x, side.normal(v), deepest_overlap(side.curve, std::max(v.before, v.after))};
  const auto hit = project_onto_curve(side.mesh.nodes, other.curve, line);
  if (!hit) return {};
  const double length = edge_length(other.mesh.nodes, other.curve.edges[hit->edge]);
  if (std::abs(hit->distance) > std::max(edge, length) / 2) return {};
  return Corner{wedge(straight, other.law), false, length};
}

Meeting meeting_of(const Corner& a, const Corner& b) {
  if (a.end && b.end) return Meeting::ends;
  const double both = a.wedge.angle + b.wedge.angle;
  return a.end || b.end || both < 2 * straight - missed ? Meeting::corner : Meeting::kink;
}

// One kink of both, that of the sharper one if the other's mesh misses it.
void fit_kink(Wedge& a, Wedge& b) {
  if (std::abs(a.angle - straight) > std::abs(b.angle - straight))
    b.angle = 2 * straight - a.angle;
  else
    a.angle = 2 * straight - b.angle;
}

SingularPoint singular_point(const Vec2& x, const Corner& a, const Corner& b, TipTable& tips) {
  SingularPoint point{x, std::max(a.edge, b.edge), 1, 1, meeting_of(a, b), {a.wedge, b.wedge}};
  auto& [first, second] = point.wedges;
  const bool kink = point.meeting == Meeting::kink;
  if (kink) fit_kink(first, second);
  const TipExponents found = kink ? tips.kinks(first, second) : tips.ends(first, second);
  point.exponent = found.stress.real();
  if (found.pressure.real() <= singular_limit) point.pressure_exponent = found.pressure.real();
  return point;
}

}  // namespace

std::vector<SingularPoint> singular_points(const Mesh& mesh, const SideTable& table, const Curve& first,
                                           const Curve& second, const Constraints& constraints,
                                           const std::vector<ElasticLaw>& laws, TipTable& tips) {
  const Side sides[] = {{mesh, table, first, constraints, laws[first.body], ContactLine(mesh.nodes, first)},
                        {mesh, table, second, constraints, laws[second.body], ContactLine(mesh.nodes, second)}};
  std::vector<SingularPoint> points;
  for (const int k : {0, 1})
    for (const Vertex& v : vertices_of(sides[k].curve)) {
      if (!v.is_end() && !sides[k].is_kink(v)) continue;
      const Vec2 x = sides[k].position(v);
      const Corner corner = sides[k].corner(v);
      const bool known = std::ranges::any_of(
          points, [&](const SingularPoint& p) { return (p.position - x).norm() < 0.05 * corner.edge; });
      const auto opposite = known ? std::nullopt : facing(sides[k], v, sides[1 - k]);
      if (!opposite) continue;
      const SingularPoint point =
          k == 0 ? singular_point(x, corner, *opposite, tips) : singular_point(x, *opposite, corner, tips);
      if (point.exponent <= singular_limit) points.push_back(point);
    }
  return points;
}

double corner_exponent(const Mesh& mesh, int node, const Constraints& constraints, const ElasticLaw& law) {
  const std::vector<Edge> outline = outline_at(mesh, SideTable(mesh), node);
  if (outline.size() != 2) return 1;
  const bool ordered = outline[0].nodes[1] == node;
  const Edge &before = outline[ordered ? 0 : 1], &after = outline[ordered ? 1 : 0];
  const double angle =
      interior_angle(edge_point(mesh.nodes, before, 1).tangent, edge_point(mesh.nodes, after, -1).tangent);
  return wedge_exponent(wedge(angle, law, face_of(mesh.nodes, before, constraints)),
                        face_of(mesh.nodes, after, constraints))
      .real();
}

}  // namespace mortise
