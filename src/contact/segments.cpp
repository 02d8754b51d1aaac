#include "contact/segments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/gap_cuts.hpp"
#include "fem/edges.hpp"
#include "fem/quadrature.hpp"

namespace mortise {
namespace {

// Where on edge e of the multiplier side a normal passes through x.
std::optional<double> foot_on(const Points& nodes, const Curve& curve, int e, const Vec2& x,
                              const ContactGeometry& geometry) {
  if (!geometry.normals) return foot_on_edge(nodes, curve.edges[e], x);
  const auto foot = geometry.multiplier->foot(e, x, 0);
  if (!foot) return {};
  const Vec2 n = geometry.multiplier->at(e, *foot).normal();
  const auto hit = project_onto_edge(nodes, curve, e, {x, -n, std::numeric_limits<double>::infinity()});
  return hit ? std::optional(hit->xi) : std::nullopt;
}

// Start and end node of the opposite edges first .. last.
std::vector<int> vertices_between(const Curve& opposite, int first, int last) {
  std::vector<int> vertices;
  for (int e = first; e <= last; ++e) vertices.push_back(opposite.edges[e].nodes[0]);
  vertices.push_back(opposite.edges[last].nodes[1]);
  return vertices;
}

// Where the pieces of both lines meet within their edges: edge e of the multiplier side, first .. last of the other.
// The normal and the gap are smooth between these places only.
std::vector<Vec2> knots_between(const ContactGeometry& geometry, int e, int first, int last) {
  std::vector<Vec2> knots;
  const auto add = [&](const ContactLine& line, int edge) {
    const std::span<const LinePiece> pieces = line.pieces(edge);
    for (std::size_t k = 1; k < pieces.size(); ++k) knots.push_back(line.at(edge, pieces[k].begin).position);
  };
  if (geometry.normals) add(*geometry.multiplier, e);
  if (geometry.gap)
    for (int edge = first; edge <= last; ++edge) add(*geometry.opposite, edge);
  return knots;
}

// Where to cut one edge, ascending, from -1 to 1. Cuts nearer than projection_tolerance to another are one cut.
std::vector<double> cuts_of(const Points& nodes, const Curve& curve, int e, const Curve& opposite,
                            const ContactGeometry& geometry) {
  const auto from = project_onto_curve(nodes, opposite, geometry.line_from(nodes, curve, {e, -1})),
             to = project_onto_curve(nodes, opposite, geometry.line_from(nodes, curve, {e, 1}));
  int first = 0, last = int(opposite.edges.size()) - 1;  // an end that hits nothing: look through the whole curve
  if (from && to) {
    first = std::min(from->edge, to->edge);
    last = std::max(from->edge, to->edge);
    if (opposite.closed && last - first > int(opposite.edges.size()) / 2) {  // across the seam of a closed curve
      first = 0;
      last = int(opposite.edges.size()) - 1;
    }
  }
  std::vector<double> feet;
  for (const int vertex : vertices_between(opposite, first, last))
    if (const auto foot = foot_on(nodes, curve, e, nodes.row(vertex).transpose(), geometry)) feet.push_back(*foot);
  for (const Vec2& knot : knots_between(geometry, e, first, last))
    if (const auto foot = foot_on(nodes, curve, e, knot, geometry)) feet.push_back(*foot);
  std::sort(feet.begin(), feet.end());
  std::vector<double> cuts{-1};
  for (const double foot : feet)
    if (foot > cuts.back() + projection_tolerance && foot < 1 - projection_tolerance) cuts.push_back(foot);
  cuts.push_back(1);
  return cuts;
}

// The pieces of each segment between cuts of its edge.
std::vector<Segment> cut(const std::vector<Segment>& segments, const std::vector<std::vector<double>>& cuts) {
  std::vector<Segment> pieces;
  for (Segment piece : segments) {
    const double end = piece.end;
    for (const double at : cuts[piece.edge]) {
      if (at <= piece.begin || at >= end) continue;
      piece.end = at;
      pieces.push_back(piece);
      piece.begin = at;
    }
    piece.end = end;
    pieces.push_back(piece);
  }
  return pieces;
}

int gauss_count(const Edge& edge, const Edge& opposite, const Model& model) {
  constexpr int of_gap = 2;
  const int of_multiplier = edge.node_count - 1, of_radius = model.axisymmetric(),
            degree = of_multiplier + std::max({of_multiplier, opposite.node_count - 1, of_gap}) + of_radius;
  return (degree + 2) / 2;
}

}  // namespace

std::vector<Segment> find_segments(const Points& nodes, const ContactInterface& interface) {
  const Curve &multiplier = interface.multiplier, &opposite = interface.opposite;
  const ContactGeometry& geometry = interface.geometry;
  std::vector<Segment> segments;
  for (int e = 0; e < int(multiplier.edges.size()); ++e) {
    const std::vector<double> cuts = cuts_of(nodes, multiplier, e, opposite, geometry);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
      if (const auto hit = project_onto_curve(nodes, opposite,
                                              geometry.line_from(nodes, multiplier, {e, (cuts[i] + cuts[i + 1]) / 2})))
        segments.push_back({e, cuts[i], cuts[i + 1], hit->edge});
  }
  return segments;
}

namespace {

// Of the edge: a strain or a turn that closes more of it within the edge is no small one, and results/line_checks.cpp
// and large_displacement.cpp judge it.
constexpr double least_step = 0.02;
constexpr double steep = 0.1;           // slope of a gap: turns that close it are told of likewise, by their square
constexpr double one_direction = 1e-6;  // radians: of the normals of two facets of a straight line

class Steps {
 public:
  Steps(const Points& nodes, const ContactInterface& interface, const std::vector<Segment>& segments)
      : nodes_(nodes), interface_(interface), segments_(segments) {}

  // The segment next to one by 1 or -1 that begins where it ends; -1 if there is none.
  int beside(int k, int step) const {
    const int count = int(segments_.size()), edges = int(interface_.multiplier.edges.size());
    const bool closed = interface_.multiplier.closed;
    int next = k + step;
    if (closed) next = (next + count) % count;
    if (next < 0 || next >= count || next == k) return -1;
    const Segment &first = segments_[step > 0 ? k : next], &second = segments_[step > 0 ? next : k];
    if (first.edge == second.edge) return std::abs(first.end - second.begin) < projection_tolerance ? next : -1;
    const bool follows = closed ? (first.edge + 1) % edges == second.edge : first.edge + 1 == second.edge;
    return follows && first.end == 1 && second.begin == -1 ? next : -1;
  }

  // Where the gap steps up between a segment and the one behind it: 1 behind, -1 before, 0 nowhere.
  int far_side(int k, int behind) const {
    const Segment &first = segments_[k], &second = segments_[behind];
    const Line before = line(first.edge, first.end), after = line(second.edge, second.begin);
    const auto from = project_onto_edge(nodes_, interface_.opposite, first.opposite_edge, before),
               to = project_onto_edge(nodes_, interface_.opposite, second.opposite_edge, after);
    if (!from || !to || turns_by_facets(before, after)) return 0;
    const double rise = to->distance - from->distance;
    if (std::abs(rise) > least_step * length(rise > 0 ? first.edge : second.edge)) return rise > 0 ? 1 : -1;
    const int way = steep_side(slope(before, *from), slope(after, *to));
    return way > 0 && rises(behind, 1, first.edge, from->distance) ? 1
           : way < 0 && rises(k, -1, second.edge, to->distance)    ? -1
                                                                   : 0;
  }

  // Whether two edges have a vertex in common.
  bool touch(int one, int other) const {
    const int apart = std::abs(one - other), edges = int(interface_.multiplier.edges.size());
    return apart <= 1 || (interface_.multiplier.closed && apart == edges - 1);
  }

 private:
  // At a corner, by the slopes on both sides of it: the side on which the gap opens at once, if not on both.
  static int steep_side(double before, double behind) {
    if (behind - before <= steep) return 0;
    const bool opens_before = -before > steep, opens_behind = behind > steep;
    return opens_before == opens_behind ? 0 : opens_behind ? 1 : -1;
  }

  // Whether from a segment on the gap becomes wider than at the corner before it by more than what is no step, on the
  // edges that touch the one on the corner's near side: a notch less deep than that is none either.
  bool rises(int k, int way, int near, double gap) const {
    const double least = least_step * length(near);
    for (int i = k; i >= 0 && touch(segments_[i].edge, near); i = beside(i, way)) {
      const Segment& segment = segments_[i];
      const auto hit = project_onto_edge(nodes_, interface_.opposite, segment.opposite_edge,
                                         line(segment.edge, way > 0 ? segment.end : segment.begin));
      if (hit && hit->distance - gap > least) return true;
    }
    return false;
  }

  // Facets have corners that the drawn curve has not.
  bool turns_by_facets(const Line& before, const Line& after) const {
    return !interface_.geometry.normals && (before.n - after.n).norm() > one_direction;
  }

  // Of the gap along the multiplier side.
  double slope(const Line& from, const Hit& hit) const {
    const ContactGeometry& geometry = interface_.geometry;
    if (!geometry.normals || !geometry.opposite) return 0;
    const Vec2 opposite = geometry.opposite->at(hit.edge, hit.xi).tangent, along(-from.n.y(), from.n.x());
    return opposite.dot(from.n) / opposite.dot(along);
  }

  Line line(int edge, double xi) const {
    return interface_.geometry.line_from(nodes_, interface_.multiplier, {edge, xi});
  }
  double length(int edge) const { return edge_length(nodes_, interface_.multiplier.edges[edge]); }

  const Points& nodes_;
  const ContactInterface& interface_;
  const std::vector<Segment>& segments_;
};

}  // namespace

std::vector<Segment> up_to_steps(const Points& nodes, const ContactInterface& interface,
                                 std::vector<Segment> segments) {
  if (interface.geometry.given || interface.geometry.beyond_steps) return segments;
  const Steps steps(nodes, interface, segments);
  std::vector<char> far(segments.size(), 0);
  for (int k = 0; k < int(segments.size()); ++k) {
    const int behind = steps.beside(k, 1);
    const int way = behind < 0 ? 0 : steps.far_side(k, behind);
    if (way == 0) continue;
    const int near = way > 0 ? k : behind;
    for (int i = way > 0 ? behind : k; i >= 0 && steps.touch(segments[i].edge, segments[near].edge);) {
      far[i] = 1;
      const int next = steps.beside(i, way);
      if (next < 0 || next == near || steps.far_side(way > 0 ? i : next, way > 0 ? next : i) != 0) break;
      i = next;
    }
  }
  std::size_t at = 0;
  std::erase_if(segments, [&](const Segment&) { return far[at++] != 0; });
  return segments;
}

std::optional<ContactPoint> contact_point(const Points& nodes, const ContactInterface& interface, int edge, double xi,
                                          int opposite_edge) {
  const Line line = interface.geometry.line_from(nodes, interface.multiplier, {edge, xi});
  std::optional<Hit> hit;
  if (opposite_edge >= 0) hit = project_onto_edge(nodes, interface.opposite, opposite_edge, line);
  if (!hit) hit = project_onto_curve(nodes, interface.opposite, line);
  if (!hit) return {};
  return ContactPoint{.edge = edge,
                      .xi = xi,
                      .ds = 0,
                      .dA = 0,
                      .normal = line.n,
                      .opposite_edge = hit->edge,
                      .eta = hit->xi,
                      .gap = interface.geometry.initial_gap(line, {edge, xi}, *hit)};
}

std::vector<ContactPoint> contact_points(const Points& nodes, const ContactInterface& interface,
                                         Integration integration) {
  const Curve &multiplier = interface.multiplier, &opposite = interface.opposite;
  const ContactGeometry& geometry = interface.geometry;
  std::vector<Segment> pieces;
  if (integration == Integration::segments) {
    pieces = up_to_steps(nodes, interface, find_segments(nodes, interface));
  } else {
    for (int e = 0; e < int(multiplier.edges.size()); ++e) pieces.push_back({e, -1, 1, -1});
  }
  if (const auto cuts = gap_cuts(nodes, multiplier, geometry); !cuts.empty()) pieces = cut(pieces, cuts);
  std::vector<ContactPoint> points;
  for (const Segment& piece : pieces) {
    const Edge& edge = multiplier.edges[piece.edge];
    const Edge& other = opposite.edges[std::max(piece.opposite_edge, 0)];
    const LineRule rule = gauss_legendre(gauss_count(edge, other, geometry.model));
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double half = (piece.end - piece.begin) / 2, xi = piece.begin + half * (1 + rule.points[q]);
      // A segment knows its opposite edge, but where a cut was merged away.
      std::optional<ContactPoint> point = contact_point(nodes, interface, piece.edge, xi, piece.opposite_edge);
      if (!point) continue;
      const EdgePoint at = edge_point(nodes, edge, xi);
      point->ds = rule.weights[q] * half * at.jacobian();
      point->dA = point->ds * geometry.model.depth(at.position.x());
      points.push_back(*point);
    }
  }
  return points;
}

double covered_part(const Points& nodes, const Curve& curve, const Curve& opposite) {
  static const LineRule rule = gauss_legendre(2);
  double length = 0, covered = 0;
  for (int e = 0; e < int(curve.edges.size()); ++e)
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double ds = rule.weights[q] * edge_point(nodes, curve.edges[e], rule.points[q]).jacobian();
      length += ds;
      if (project_onto_curve(nodes, opposite, line_from(nodes, curve, e, rule.points[q]))) covered += ds;
    }
  return covered / length;
}

}  // namespace mortise
