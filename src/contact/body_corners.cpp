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

// The wedges of the cells around a node, those of one material as one.
Fan fan_from(const Mesh& mesh, std::span<const SideAtNode> sides, int first, const std::vector<ElasticLaw>& laws) {
  Fan fan;
  const auto [angles, closed] = bodies_around(mesh, sides, first);
  for (const auto& [body, angle] : angles) {
    const Wedge next = wedge(angle, laws[body]);
    if (!fan.wedges.empty() && fan.wedges.back().is_alike(next))
      fan.wedges.back().angle += angle;
    else
      fan.wedges.push_back(next);
  }
  if (!fan.wedges.empty()) fan.joints.assign(fan.wedges.size() - (closed ? 0 : 1), Joint::bonded);
  return fan;
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
  const double angle = fan.wedges[0].angle;
  if (fan.first == Face::free && fan.last == Face::free) return angle < least_free_angle();
  return fan.first == fan.last && std::abs(angle - straight) < smooth;
}

double exponent_of(Fan fan, TipTable& tips) {
  for (Wedge& w : fan.wedges) w.angle = alike_angle * std::round(w.angle / alike_angle);
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

AnglesAround bodies_around(const Mesh& mesh, std::span<const SideAtNode> sides, int first) {
  AnglesAround around{{}, false};
  int from = first;
  for (std::size_t k = 0; k < sides.size() && !around.closed; ++k) {
    const auto begin =
        std::ranges::find_if(sides, [&](const SideAtNode& side) { return side.starts && side.other == from; });
    if (begin == sides.end()) break;
    const auto end = std::ranges::find_if(
        sides, [&](const SideAtNode& side) { return !side.starts && side.side.cell == begin->side.cell; });
    const int body = mesh.cells[begin->side.cell].body;
    if (around.angles.empty() || around.angles.back().first != body) around.angles.emplace_back(body, 0);
    around.angles.back().second += angle_from(direction_at(mesh, *begin), direction_at(mesh, *end));
    from = end->other;
    around.closed = from == first;
  }
  return around;
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

double interior_angle(const Vec2& before, const Vec2& after) {
  return straight - std::atan2(cross(before, after), before.dot(after));
}

std::vector<BodyCorner> body_corners(const Surroundings& around) {
  const auto& [mesh, table, constraints, laws, tips] = around;
  std::vector<BodyCorner> corners;
  for (int node = 0; node < int(mesh.nodes.rows()); ++node) {
    const auto sides = table.at(node);
    if (sides.empty()) continue;
    Fan fan;
    if (const std::vector<Edge> outline = outline_at(mesh, table, node); outline.size() == 2) {
      const bool ordered = outline[0].nodes[1] == node;
      const Edge &before = outline[ordered ? 0 : 1], &after = outline[ordered ? 1 : 0];
      fan = fan_from(mesh, sides, after.nodes[1], laws);
      fan.first = face_of(mesh.nodes, after, constraints);
      fan.last = face_of(mesh.nodes, before, constraints);
    } else if (outline.empty() && several_materials(mesh, sides, laws)) {
      fan = fan_from(mesh, sides, sides[0].other, laws);
    } else {
      continue;
    }
    if (is_regular(fan)) continue;
    const double exponent = exponent_of(fan, tips);
    if (exponent <= singular_limit) corners.push_back({node, mesh.nodes.row(node).transpose(), exponent});
  }
  return corners;
}

double corner_exponent(const Mesh& mesh, int node, const Constraints& constraints, const ElasticLaw& law) {
  const SideTable table(mesh);
  const std::vector<Edge> outline = outline_at(mesh, table, node);
  if (outline.size() != 2) return 1;
  const bool ordered = outline[0].nodes[1] == node;
  const Edge &before = outline[ordered ? 0 : 1], &after = outline[ordered ? 1 : 0];
  double angle = 0;
  for (const auto& [body, of_body] : bodies_around(mesh, table.at(node), after.nodes[1]).angles) angle += of_body;
  return exponents({{wedge(angle, law)},
                    {},
                    face_of(mesh.nodes, after, constraints),
                    face_of(mesh.nodes, before, constraints)})
      .stress.real();
}

}  // namespace mortise
