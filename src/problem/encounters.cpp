#include "problem/encounters.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/each_once.hpp"
#include "base/parallel.hpp"
#include "fem/edges.hpp"
#include "fem/quadrature.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

constexpr double slack = 0.01, slack_beside_pair = 0.001;  // of the shorter edge

// How far two edges may lie apart where they stand for one curve.
double mesh_gap(const Outline& o, int edge, int other) { return 2 * (o.sagitta[edge] + o.sagitta[other]); }

double shorter(const Outline& o, int edge, int other) { return std::min(o.length[edge], o.length[other]); }

// What one point of an edge sees.
void look(const AuditedBodies& b, const EdgePoint& at, double ds, Encounter& found, bool& all_tight) {
  const Outline& o = b.outline;
  const OutlinePlace place = nearest(o, found.piece, at.position);
  const double size = shorter(o, found.edge, place.edge), gap = mesh_gap(o, found.edge, place.edge),
               distance = std::abs(place.distance);
  const bool close = distance <= gap + slack * size, facing = face_each_other(at.normal(), place);
  const bool bonded = o.edges[found.edge].shared || o.edges[place.edge].shared;
  all_tight = all_tight && facing && distance <= gap + slack_beside_pair * size;
  if (close && facing && !bonded && !paired(b, found.edge, place.edge)) {
    found.meets += ds;
    found.facing.push_back(place.edge);
  }
  const bool along = close && !place.vertex && at.normal().dot(place.normal) > 0.9;
  if (!along && (close || place.distance > 0)) return;
  found.inside += ds;
  found.depth = std::max(found.depth, -place.distance);
  found.overlap += std::max(0., -place.distance) * ds;
  found.facing.push_back(place.edge);
}

Encounter encounter(const AuditedBodies& b, int edge, int piece) {
  const Outline& o = b.outline;
  Encounter found{edge, piece, 0, 0, 0, 0, {}};
  bool all_tight = true;
  static const LineRule rule = gauss_legendre(3);
  for (std::size_t i = 0; i < rule.points.size(); ++i) {
    const EdgePoint at = edge_point(o.nodes, o.edges[edge].edge, rule.points[i]);
    look(b, at, rule.weights[i] * at.jacobian(), found, all_tight);
  }
  keep_each_once(found.facing);
  const bool beside =
      std::any_of(found.facing.begin(), found.facing.end(), [&](int other) { return nearly_paired(b, edge, other); });
  if (beside && !all_tight) found.meets = 0;
  return found;
}

}  // namespace

std::vector<Encounter> encounters(const AuditedBodies& b) {
  const Outline& o = b.outline;
  const double sagitta = o.sagitta.empty() ? 0 : *std::max_element(o.sagitta.begin(), o.sagitta.end());
  std::vector<std::vector<Encounter>> of_edges(o.edges.size());
  for_each_index(o.edges.size(), solver_threads(), [&](std::size_t k) {
    const int e = int(k);
    for (const int piece : o.boxes.meeting(edge_box(o, e, 4 * sagitta + slack * o.length[e]))) {
      if (piece == o.edges[e].piece) continue;
      Encounter found = encounter(b, e, piece);
      if (found.meets > 0 || found.inside > 0) of_edges[e].push_back(std::move(found));
    }
  });
  std::vector<Encounter> list;
  for (std::vector<Encounter>& of_edge : of_edges) std::ranges::move(of_edge, std::back_inserter(list));
  std::stable_sort(list.begin(), list.end(), [&](const Encounter& x, const Encounter& y) {
    return std::pair(o.edges[x.edge].piece, x.piece) < std::pair(o.edges[y.edge].piece, y.piece);
  });
  return list;
}

}  // namespace mortise
