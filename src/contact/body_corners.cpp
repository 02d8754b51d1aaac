#include "contact/body_corners.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vectors.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

constexpr double alike_angle = 1e-4;                   // radians; exponents differ by less than that
constexpr double smooth = 2 * std::numbers::pi / 180;  // an edge's end is off by less on a curve

// Free faces: sin(lambda w) + lambda sin w = 0 (Williams 1952) has its zero at singular_limit there, at 185 degrees; a
// smaller angle has a larger one.
double least_free_angle() {
  static const double angle = [] {
    double low = straight + 0.01, high = 1.5 * straight;
    const auto value = [](double w) { return std::sin(singular_limit * w) + singular_limit * std::sin(w); };
    for (int k = 0; k < 50; ++k) {
      const double middle = (low + high) / 2;
      (value(middle) * value(low) > 0 ? low : high) = middle;
    }
    return low;
  }();
  return angle;
}

Vec2 direction_at(const Mesh& mesh, const SideAtNode& side) {
  const Edge edge = side_edge(mesh.cells[side.side.cell], side.side.side);
  return side.starts ? edge_point(mesh.nodes, edge, -1).tangent : Vec2(-edge_point(mesh.nodes, edge, 1).tangent);
}

double angle_from(const Vec2& a, const Vec2& b) {
  const double angle = std::atan2(cross(a, b), a.dot(b));
  return angle > 0 ? angle : angle + 2 * straight;
}

bool same_law(const ElasticLaw& a, const ElasticLaw& b) { return a.stiffness == b.stiffness; }

// The wedges of what is around a vertex, those of one material as one. Of several turns about the origin nothing.
Fan fan_of(const Surroundings& around, const BodiesAtVertex& at) {
  Fan fan{{}, {}, face_at(around, at.first), face_at(around, at.last)};
  if (at.turn != 0) return fan;
  for (const BodyAtVertex& b : at.bodies) {
    const Wedge next = wedge(b.angle, around.laws[b.body], Face::free, b.first);
    if (!fan.wedges.empty() && fan.wedges.back().goes_on_in(next))
      fan.wedges.back().angle += b.angle;
    else
      fan.wedges.push_back(next);
  }
  if (!fan.wedges.empty()) fan.joints.assign(fan.wedges.size() - (at.closed ? 0 : 1), Joint::bonded);
  return fan;
}

// The bodies whose cells stand around a vertex, counter-clockwise from the side to the node `first`.
BodiesAtVertex bodies_from(const Surroundings& around, int node, int first) {
  const auto sides = around.table.at(node);
  BodiesAtVertex at{{}, {node, first}, {node, first}};
  for (std::size_t k = 0; k < sides.size() && !at.closed; ++k) {
    const auto begin =
        std::ranges::find_if(sides, [&](const SideAtNode& side) { return side.starts && side.other == at.last.other; });
    if (begin == sides.end()) break;
    const auto end = std::ranges::find_if(
        sides, [&](const SideAtNode& side) { return !side.starts && side.side.cell == begin->side.cell; });
    const int body = around.mesh.cells[begin->side.cell].body;
    const Vec2 direction = direction_at(around.mesh, *begin);
    if (at.bodies.empty() || at.bodies.back().body != body) at.bodies.push_back({body, node, 0, angle_of(direction)});
    at.bodies.back().angle += angle_from(direction, direction_at(around.mesh, *end));
    at.last.other = end->other;
    at.closed = at.last.other == first;
  }
  return at;
}

// Those between two edges of the outline, one of which is given.
BodiesAtVertex bodies_behind(const Surroundings& around, const EdgeAtVertex& face) {
  for (const Edge& edge : outline_at(around.mesh, around.table, face.vertex)) {
    if (edge.nodes[0] != face.vertex) continue;
    const BodiesAtVertex at = bodies_from(around, face.vertex, edge.nodes[1]);
    if (at.first == face || at.last == face) return at;
  }
  return {{}, face, face};
}

bool several_materials(const Mesh& mesh, std::span<const SideAtNode> sides, const std::vector<ElasticLaw>& laws) {
  const int body = mesh.cells[sides[0].side.cell].body;
  return std::ranges::any_of(sides, [&](const SideAtNode& side) {
    const int other = mesh.cells[side.side.cell].body;
    return other != body && !same_law(laws[other], laws[body]);
  });
}

// Whether its exponent is known to be above the limit without a search.
bool is_regular(const Fan& fan) {
  if (fan.wedges.size() != 1) return fan.wedges.empty();
  if (!fan.joints.empty()) return true;  // inside one material
  const double angle = fan.wedges[0].angle;
  if (fan.first == Face::free && fan.last == Face::free)
    return angle < (!fan.wedges[0].first ? least_free_angle() : straight + smooth);
  return fan.first == fan.last && std::abs(angle - straight) < smooth;
}

double exponent_of(Fan fan, TipTable& tips) {
  for (Wedge& w : fan.wedges) w.round(alike_angle);
  return tips.find(fan).stress.real();
}

}  // namespace

std::vector<Edge> outline_at(const Mesh& mesh, const SideTable& table, int node) {
  std::vector<Edge> outline;
  for (const SideAtNode& at : table.at(node))
    if (std::ranges::none_of(table.at(node), [&](const SideAtNode& behind) {
          return behind.other == at.other && behind.starts != at.starts;
        }))
      outline.push_back(side_edge(mesh.cells[at.side.cell], at.side.side));
  return outline;
}

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

double angle_of(const Vec2& direction) { return std::atan2(direction.y(), direction.x()); }

double interior_angle(const Vec2& before, const Vec2& after) {
  return straight - std::atan2(cross(before, after), before.dot(after));
}

Face face_at(const Surroundings& around, const EdgeAtVertex& face) {
  if (face.vertex < 0) return Face::free;
  for (const Edge& edge : outline_at(around.mesh, around.table, face.vertex))
    if (edge.nodes[0] == face.other || edge.nodes[1] == face.other)
      return face_of(around.mesh.nodes, edge, around.constraints);
  return Face::free;
}

BodiesAtVertex bodies_at(const Surroundings& around, const EdgeAtVertex& face) {
  BodiesAtVertex at = bodies_behind(around, face);
  for (const bool ahead : {false, true}) {
    double turn = 0;
    EdgeAtVertex& end = ahead ? at.last : at.first;
    while (const AcrossTie* tie = at.closed ? nullptr : around.ties.across(end)) {
      turn += tie->turn;
      at.closed = tie->edge == (ahead ? at.first : at.last);
      if (at.closed) break;
      const double first = ahead ? at.bodies.back().first + at.bodies.back().angle : at.bodies.front().first - straight;
      BodiesAtVertex next{{{tie->body, -1, straight, first}}, tie->edge, tie->edge};
      if (tie->edge.vertex >= 0) {
        if (std::ranges::count(at.bodies, tie->edge.vertex, &BodyAtVertex::node) > 0) break;
        next = bodies_behind(around, tie->edge);
      }
      for (BodyAtVertex& b : next.bodies) b.turn = turn;
      at.bodies.insert(ahead ? at.bodies.end() : at.bodies.begin(), next.bodies.begin(), next.bodies.end());
      end = ahead ? next.last : next.first;
    }
    if (at.closed) at.turn = turn;
  }
  return at;
}

namespace {

// Of a vertex of an outline or where materials meet; no wedges: none of them.
Fan fan_at(const Surroundings& around, int node) {
  const auto sides = around.table.at(node);
  if (sides.empty()) return {};
  const std::vector<Edge> outline = outline_at(around.mesh, around.table, node);
  if (outline.size() == 2) {
    const Edge& after = outline[outline[0].nodes[0] == node ? 0 : 1];
    return fan_of(around, bodies_at(around, {node, after.nodes[1]}));
  }
  if (outline.empty() && several_materials(around.mesh, sides, around.laws))
    return fan_of(around, bodies_from(around, node, sides[0].other));
  return {};
}

}  // namespace

std::vector<BodyCorner> body_corners(const Surroundings& around) {
  std::vector<BodyCorner> corners;
  for (int node = 0; node < int(around.mesh.nodes.rows()); ++node) {
    const Fan fan = fan_at(around, node);
    if (is_regular(fan)) continue;
    const double exponent = exponent_of(fan, around.tips);
    if (exponent <= singular_limit) corners.push_back({node, around.mesh.nodes.row(node).transpose(), exponent});
  }
  return corners;
}

double corner_exponent(const Surroundings& around, int node) {
  const Fan fan = fan_at(around, node);
  return is_regular(fan) ? 1 : around.tips.find(fan).stress.real();
}

}  // namespace mortise
