#include "error/contact_reach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/least_gap.hpp"
#include "error/pressure_swing.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// Where a single vertex is closed, the edges on both sides of it are not known to be open.
Reach reach_of(bool closed, bool before, bool after, bool faced_before, bool faced_after) {
  if (!closed) return {false, false};
  return before || after ? Reach{before, after} : Reach{faced_before, faced_after};
}

// Of each edge whether the sides overlap at the contact points nearest to its start and its end.
std::vector<std::array<bool, 2>> overlaps_at_ends(const ContactPair& pair, const VecX& u) {
  std::vector<std::array<bool, 2>> overlaps(pair.multiplier.edges.size(), {false, false});
  std::vector<Vec2> nearest(overlaps.size(), Vec2(1, -1));
  for (const ContactPoint& point : pair.points)
    for (const int end : {0, 1}) {
      double& xi = nearest[point.edge](end);
      if (end == 0 ? point.xi >= xi : point.xi <= xi) continue;
      xi = point.xi;
      overlaps[point.edge][end] = gap_at(u, pair, point) <= 0;
    }
  return overlaps;
}

// A row holds the gap in the mean of its edges: at a corner beyond which it is wide the row may be open though the
// sides are closed, and overlap, up to the corner.
std::vector<Reach> by_vertices(const ContactPair& pair, const PressureLine& line, const VecX& u) {
  const std::vector<std::array<bool, 2>> overlaps = overlaps_at_ends(pair, u);
  const Eigen::Index last = line.p.size() - 1;
  const auto closed = [&](Eigen::Index i) { return line.p(i) != 0; };
  std::vector<Reach> reach;
  for (Eigen::Index i = 0; i <= last; ++i) {
    const auto [faced_before, faced_after] = line.faced_beside(i);
    const Eigen::Index edge_before = i > 0 ? i - 1 : last - 1, edge_after = i < last ? i : 0;
    const bool before = faced_before && closed(edge_before), after = faced_after && closed(edge_after + 1);
    if (closed(i))
      reach.push_back(reach_of(true, before, after, faced_before, faced_after));
    else
      reach.push_back({before && overlaps[edge_before][1], after && overlaps[edge_after][0]});
  }
  return reach;
}

// Of an opposite edge, whether contact is closed at the contact point nearest to each end, and in the half beyond its
// middle: where p is at both ends of the multiplier side's edge, or at one and the sides overlap, as where a stiff
// corner opens the vertex beside it.
struct FacingEdge {
  std::array<double, 2> away{3, 3};  // of that point from the end, in the edge's coordinate
  std::array<bool, 2> closed{false, false}, closed_beyond{false, false};
};

std::vector<FacingEdge> facing_edges(const ContactPair& pair, const PressureLine& line, const VecX& u) {
  std::vector<FacingEdge> edges(pair.opposite.edges.size());
  for (const ContactPoint& point : pair.points) {
    const int ends = (line.p(point.edge) != 0) + (line.p(point.edge + 1) != 0);
    const bool closed = ends == 2 || (ends == 1 && gap_at(u, pair, point) <= 0);
    FacingEdge& edge = edges[point.opposite_edge];
    for (const int end : {0, 1}) {
      const double away = std::abs(point.eta - (2 * end - 1));
      if (away < edge.away[end]) {
        edge.away[end] = away;
        edge.closed[end] = closed;
      }
      edge.closed_beyond[end] = edge.closed_beyond[end] || (away >= 1 && closed);
    }
  }
  return edges;
}

// Of each vertex of the opposite side whether edges before and after it face the other.
std::vector<Reach> faced_by_points(const std::vector<FacingEdge>& edges, bool closed) {
  const std::size_t count = edges.size();
  const auto faced = [&](std::size_t edge, int end) { return edges[edge].away[end] < 2; };
  std::vector<Reach> all;
  for (std::size_t i = 0; i <= count; ++i)
    all.push_back({(i > 0 || closed) && faced(i > 0 ? i - 1 : count - 1, 1),
                   (i < count || closed) && faced(i < count ? i : 0, 0)});
  return all;
}

std::vector<Reach> by_points(const std::vector<FacingEdge>& edges, bool closed, const std::vector<Reach>& faced) {
  const std::size_t count = edges.size();
  std::vector<Reach> reach;
  for (std::size_t i = 0; i <= count; ++i) {
    FacingEdge before, after;
    if (i > 0 || closed) before = edges[i > 0 ? i - 1 : count - 1];
    if (i < count || closed) after = edges[i < count ? i : 0];
    reach.push_back(reach_of(before.closed[1] || after.closed[0], before.closed[1] && before.closed_beyond[1],
                             after.closed[0] && after.closed_beyond[0], faced[i].before, faced[i].after));
  }
  return reach;
}

// Whether contact ends before a place by what is seen at the contact point nearest to it. At a border p is c sqrt(r)
// within, and beyond it the gap (4/3) c r sqrt(r) / E* (Johnson 1985, section 4.2), so that E* gap / 2 r is two thirds
// of p as far within: half of that tells a border's gap from what a mesh leaves of a corner's. The vertices next to the
// place say nothing, at the tip of a crack those over which p_h swings: it is as wrong there as stresses are large, and
// may be in tension.
bool ends_before(const Mesh& mesh, const ContactPair& pair, const PressureLine& line, double modulus, const VecX& u,
                 const FoundPoint& found) {
  const ContactPoint* nearest = nullptr;
  double away = std::numeric_limits<double>::infinity();
  for (const ContactPoint& point : pair.points) {
    const Vec2 x = edge_point(mesh.nodes, pair.multiplier.edges[point.edge], point.xi).position;
    if ((x - found.position).norm() >= away) continue;
    away = (x - found.position).norm();
    nearest = &point;
  }
  if (!nearest) return false;
  const int beside = found.swings ? swing_reach : 1;
  const Eigen::Index first = std::max(nearest->edge + 1 - beside, 0),
                     last = std::min<Eigen::Index>(nearest->edge + beside, line.p.size() - 1);
  if (line.p.segment(first, last + 1 - first).any()) return false;
  const double start = line.s(nearest->edge), end = line.s(nearest->edge + 1);
  const double at = start + (1 + nearest->xi) / 2 * (end - start);
  double p = 0, r = std::numeric_limits<double>::infinity();  // at the closed vertex nearest to that point
  for (Eigen::Index i = 0; i < line.p.size(); ++i)
    if (line.p(i) != 0 && line.distance(line.s(i), at) < r) {
      p = line.p(i);
      r = line.distance(line.s(i), at);
    }
  return p > 0 && modulus * gap_at(u, pair, *nearest) / (2 * r) > p / 3;
}

// Vertices of drawn corners are in one place on all meshes, to gmsh's round-off. Contact is found up to them from the
// sides that face the other.
void add_found(const Mesh& mesh, const Curve& curve, const std::vector<Vec2>& places, const std::vector<Reach>& faced,
               std::vector<Reach>& reach) {
  constexpr double one_place = 1e-6;  // of the edge
  for (std::size_t i = 0; i < reach.size() && !places.empty(); ++i) {
    const std::size_t e = std::min(i, curve.edges.size() - 1);
    const Vec2 x = mesh.nodes.row(curve.edges[e].nodes[i == e ? 0 : 1]).transpose();
    const double near = one_place * edge_length(mesh.nodes, curve.edges[e]);
    if (!reach[i].any() && std::ranges::any_of(places, [&](const Vec2& place) { return (place - x).norm() < near; }))
      reach[i] = faced[i].any() ? faced[i] : Reach{true, true};
  }
}

}  // namespace

bool FoundPoint::is(const FoundPoint& other) const {
  const auto& [first, second] = other.between;
  return position == other.position && (between == other.between || between == std::array{second, first});
}

std::array<std::string, 2> curve_names(const Mesh& mesh, const ContactPair& pair) {
  return {mesh.boundaries[pair.multiplier.boundary].name, mesh.boundaries[pair.opposite.boundary].name};
}

ContactReach contact_reach(const Mesh& mesh, const ContactPair& pair, const std::vector<ElasticLaw>& laws,
                           const PressureLine& line, const VecX& u, const std::vector<FoundPoint>& found) {
  const double modulus = contact_modulus(laws[pair.multiplier.body], laws[pair.opposite.body]);
  std::vector<Vec2> places;
  for (const FoundPoint& point : found)
    if (point.is({curve_names(mesh, pair), point.position}) && !ends_before(mesh, pair, line, modulus, u, point))
      places.push_back(point.position);
  const std::vector<FacingEdge> opposite = facing_edges(pair, line, u);
  std::array<std::vector<Reach>, 2> faced{{{}, faced_by_points(opposite, pair.opposite.closed)}};
  for (Eigen::Index i = 0; i < line.p.size(); ++i) {
    const auto [before, after] = line.faced_beside(i);
    faced[0].push_back({before, after});
  }
  ContactReach reach{by_vertices(pair, line, u), by_points(opposite, pair.opposite.closed, faced[1])};
  add_found(mesh, pair.multiplier, places, faced[0], reach[0]);
  add_found(mesh, pair.opposite, places, faced[1], reach[1]);
  return reach;
}

}  // namespace mortise
