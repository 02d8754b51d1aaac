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

}  // namespace

std::vector<std::string> crossing_lines(const AuditedBodies& b, const Results& r) {
  if (!r.solution.u.allFinite()) return {};
  const double largest = largest_entry(r.solution.u);
  const Outline deformed = outline(
      b.boundary, r.problem.mesh.nodes + Eigen::Map<const Points>(r.solution.u.data(), r.problem.mesh.nodes.rows(), 2));
  static const LineRule rule = gauss_legendre(3);
  std::map<std::pair<int, int>, Crossing> crossings;
  for (int e = 0; e < int(deformed.edges.size()); ++e)
    for (const int piece : deformed.boxes.meeting(edge_box(deformed, e, 0))) {
      if (piece == deformed.edges[e].piece) continue;
      for (const double xi : rule.points) {
        const auto [depth, other] = depth_at({b, deformed, largest}, e, xi, piece);
        if (other < 0) continue;
        const bool second = deformed.edges[e].body > deformed.pieces[piece].body;
        Crossing& c = crossings[std::minmax(deformed.edges[e].body, deformed.pieces[piece].body)];
        c.depth = std::max(c.depth, depth);
        c.edges.push_back(second ? other : e);
        c.others.push_back(second ? e : other);
      }
    }
  std::vector<std::string> lines;
  for (const auto& [bodies, c] : crossings) lines.push_back(line(b, bodies.first, bodies.second, c, largest));
  return lines;
}

}  // namespace mortise
