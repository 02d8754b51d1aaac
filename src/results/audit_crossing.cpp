#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "base/printable.hpp"
#include "fem/edges.hpp"
#include "fem/quadrature.hpp"
#include "results/audit_solution.hpp"

namespace mortise {
namespace {

// Less than this part of what the two bodies moved against one another, and of all displacements, is no crossing: what
// curved meshes show that slide along one another.
constexpr double of_relative = 0.01, of_largest = 1e-4;

struct Crossing {
  double depth = 0;
  std::vector<int> edges, others;
};

Vec2 displaced(const Outline& deformed, const Outline& drawn, int edge, double xi) {
  const Edge& nodes = drawn.edges[edge].edge;
  return edge_point(deformed.nodes, nodes, xi).position - edge_point(drawn.nodes, nodes, xi).position;
}

struct Moved {
  const AuditedBodies& b;
  const Outline& deformed;
  double largest;  // displacement
};

struct Depth {
  double value = 0;
  int other = -1;  // the edge of the other piece; none where nothing crosses
};

// How far a point of an edge has come into another piece; nothing where it has not, or a pair stands there.
Depth depth_at(const Moved& all, int edge, double xi, int piece) {
  const auto& [b, deformed, largest] = all;
  const Edge& nodes = deformed.edges[edge].edge;
  const OutlinePlace place = nearest(deformed, piece, edge_point(deformed.nodes, nodes, xi).position);
  if (-place.distance <= of_largest * largest || nearly_paired(b, edge, place.edge)) return {};
  const Vec2 moved = displaced(deformed, b.outline, edge, xi) - displaced(deformed, b.outline, place.edge, place.xi);
  const double drawn = nearest(b.outline, piece, edge_point(b.outline.nodes, nodes, xi).position).distance;
  const double depth = -place.distance - std::max(0., -drawn);
  if (depth <= of_relative * moved.norm() + of_largest * largest) return {};
  return {depth, place.edge};
}

std::string line(const AuditedBodies& b, int first, int second, const Crossing& c, double largest) {
  std::ostringstream text;
  text << two_bodies(b.mesh, first, second) << " pass through one another by " << c.depth << " ("
       << std::lround(100 * c.depth / largest) << " % of the largest displacement) "
       << near_point(middle_of(b, c.edges)) << " (" << name_of(b, c.edges) << ", " << name_of(b, c.others)
       << "), and no contact pair keeps them apart there: the results are not those of two bodies; "
       << advice(b, c.edges, c.others);
  return text.str();
}

// `moved`: the most that any point moves by. What is nearest to a point then was farther by two such ways on either
// side than what is nearest now.
bool stays_apart(const AuditedBodies& b, const EdgeAndPiece& of, double moved) {
  const Outline& o = b.outline;
  static const LineRule rule = gauss_legendre(3);
  for (const double xi : rule.points) {
    const Vec2 x = edge_point(o.nodes, o.edges[of.edge].edge, xi).position;
    const double distance = nearest(o, of.piece, x).distance;
    if (distance > 3 * moved) continue;
    const Vec2 reach = Vec2::Constant(std::abs(distance) + 5 * moved);
    for (const int number : o.pieces[of.piece].edges.meeting(Box(x - reach, x + reach)))
      if (!nearly_paired(b, of.edge, o.pieces[of.piece].first + number)) return false;
  }
  return true;
}

// Whose boxes, larger by `margin`, meet.
std::vector<EdgeAndPiece> meeting(const Outline& o, double margin) {
  std::vector<EdgeAndPiece> list;
  for (int e = 0; e < int(o.edges.size()); ++e)
    for (const int piece : o.boxes.meeting(edge_box(o, e, margin)))
      if (piece != o.edges[e].piece) list.push_back({e, piece});
  return list;
}

void add_crossing(const Moved& all, const EdgeAndPiece& of, std::map<std::pair<int, int>, Crossing>& crossings) {
  const Outline& deformed = all.deformed;
  const int body = deformed.edges[of.edge].body, other_body = deformed.pieces[of.piece].body;
  static const LineRule rule = gauss_legendre(3);
  for (const double xi : rule.points) {
    const auto [depth, other] = depth_at(all, of.edge, xi, of.piece);
    if (other < 0) continue;
    Crossing& c = crossings[std::minmax(body, other_body)];
    c.depth = std::max(c.depth, depth);
    c.edges.push_back(body > other_body ? other : of.edge);
    c.others.push_back(body > other_body ? of.edge : other);
  }
}

}  // namespace

std::vector<EdgeAndPiece> may_cross(const AuditedBodies& b, double largest) {
  const double moved = 2 * largest;  // both components, and a point between nodes more than these
  std::vector<EdgeAndPiece> list = meeting(b.outline, 5 * moved);
  std::erase_if(list, [&](const EdgeAndPiece& of) { return stays_apart(b, of, moved); });
  return list;
}

std::vector<std::string> crossing_lines(const AuditedBodies& b, const Results& r,
                                        const std::vector<EdgeAndPiece>* some) {
  if (!r.solution.u.allFinite() || (some && some->empty())) return {};
  const double largest = largest_entry(r.solution.u);
  const Outline deformed = outline(
      b.boundary, r.problem.mesh.nodes + Eigen::Map<const Points>(r.solution.u.data(), r.problem.mesh.nodes.rows(), 2));
  std::map<std::pair<int, int>, Crossing> crossings;
  for (const EdgeAndPiece& of : some ? *some : meeting(deformed, 0))
    if (edge_box(deformed, of.edge, 0).intersects(deformed.pieces[of.piece].box))
      add_crossing({b, deformed, largest}, of, crossings);
  std::vector<std::string> lines;
  for (const auto& [bodies, c] : crossings) lines.push_back(line(b, bodies.first, bodies.second, c, largest));
  return lines;
}

}  // namespace mortise
