#include <cmath>
#include <map>

#include "base/printable.hpp"
#include "fem/edges.hpp"
#include "results/audit_solution.hpp"

namespace mortise {
namespace {

// p is exactly zero where contact is open: more than round-off of the largest means that it is closed up to the end.
constexpr double least_end_pressure = 1e-3;

// The edges of the outline by their ends: of two bodies that are bonded each has its own direction.
using EdgeAt = std::map<std::pair<int, int>, int>;

EdgeAt edges_by_ends(const Outline& outline) {
  EdgeAt edges;
  for (int e = 0; e < int(outline.edges.size()); ++e) {
    const auto& nodes = outline.edges[e].edge.nodes;
    edges.emplace(std::pair(nodes[0], nodes[1]), e);
  }
  return edges;
}

// The outline's edge next to the end of a curve, outside of it; -1 where a corner or another body ends the boundary.
int edge_beyond(const AuditedBodies& b, const EdgeAt& edges, const Curve& curve, bool at_back) {
  const Edge& last = at_back ? curve.edges.back() : curve.edges.front();
  const auto found = edges.find({last.nodes[0], last.nodes[1]});
  if (found == edges.end()) return -1;
  const int beyond = b.outline.neighbour[found->second][at_back];
  const bool smooth = beyond >= 0 && b.outline.turn[found->second][at_back] < smooth_turn;
  return smooth && !b.outline.edges[beyond].shared ? beyond : -1;
}

// Whether contact could go on: the edge faces the other body no farther away than it is long.
bool faces(const AuditedBodies& b, int edge, int body) {
  const Outline& o = b.outline;
  const EdgePoint middle = edge_point(o.nodes, o.edges[edge].edge, 0);
  const Vec2 reach = Vec2::Constant(o.length[edge]);
  for (const int p : o.boxes.meeting({middle.position - reach, middle.position + reach})) {
    if (o.pieces[p].body != body || p == o.edges[edge].piece) continue;
    const OutlinePlace place = nearest(o, p, middle.position);
    const EdgePoint there = edge_point(o.nodes, o.edges[place.edge].edge, place.xi);
    // Beside the end of the other body's outline nothing is faced: its nearest point lies sideways.
    const Vec2 away = there.position - middle.position;
    const bool ahead = std::abs(away.dot(middle.normal())) >= 0.7 * away.norm();
    if (std::abs(place.distance) < o.length[edge] && face_each_other(middle.normal(), place) && ahead) return true;
  }
  return false;
}

// One side of a pair with its results.
struct Audited {
  const Curve& curve;
  int other_body;
  const ContactSide& side;
  double p_max;  // of the pair
};

double pressure_at(const ContactSide& side, int node) {
  for (const ContactNode* end : {&side.nodes.front(), &side.nodes.back()})
    if (end->node == node) return end->p;
  return 0;
}

// Adds "'foot' near (0.1, 0)" for each end of a curve that contact reaches and should not.
void add_ends(const AuditedBodies& b, const EdgeAt& edges, const Audited& at, std::string& places) {
  const auto& [curve, other_body, side, p_max] = at;
  if (curve.closed) return;
  for (const bool at_back : {false, true}) {
    const int node = at_back ? curve.edges.back().nodes[1] : curve.edges.front().nodes[0];
    if (!(pressure_at(side, node) > least_end_pressure * p_max)) continue;
    const int beyond = edge_beyond(b, edges, curve, at_back);
    if (beyond < 0 || paired_with_body(b, beyond, other_body) || !faces(b, beyond, other_body)) continue;
    places += (places.empty() ? "'" : " and of '") + side.curve + "' " + near_point(b.mesh.nodes.row(node).transpose());
  }
}

}  // namespace

std::vector<std::string> end_lines(const AuditedBodies& b, const Results& r) {
  const EdgeAt edges = edges_by_ends(b.outline);
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k) {
    const ContactPair& pair = r.problem.pairs[k];
    const ContactResults& c = r.recovery.contacts[k];
    if (pair.spec.condition != Condition::unilateral) continue;
    std::string places;
    add_ends(b, edges, {pair.multiplier, pair.opposite.body, c.multiplier, c.p_max}, places);
    add_ends(b, edges, {pair.opposite, pair.multiplier.body, c.opposite, c.p_max}, places);
    if (!places.empty())
      lines.push_back(pair.spec.key + ": contact reaches the end of " + places +
                      ", where the boundary goes on smoothly and faces the other body: the pressure concentrates "
                      "there; extend the named curve over the rest of the boundary");
  }
  return lines;
}

}  // namespace mortise
