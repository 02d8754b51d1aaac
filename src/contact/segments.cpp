#include "contact/segments.hpp"

#include <algorithm>

#include "fem/edges.hpp"
#include "fem/quadrature.hpp"

namespace mortise {
namespace {

std::optional<Hit> hit_from(const Points& nodes, const Curve& curve, int edge, double xi, const Curve& opposite) {
  return project_onto_curve(nodes, opposite, line_from(nodes, curve, edge, xi));
}

// Start and end node of the opposite edges first .. last.
std::vector<int> vertices_between(const Curve& opposite, int first, int last) {
  std::vector<int> vertices;
  for (int e = first; e <= last; ++e) vertices.push_back(opposite.edges[e].nodes[0]);
  vertices.push_back(opposite.edges[last].nodes[1]);
  return vertices;
}

// Where to cut one edge, ascending, from -1 to 1. Cuts nearer than projection_tolerance to another are one cut.
std::vector<double> cuts_of(const Points& nodes, const Curve& curve, int e, const Curve& opposite) {
  const Edge& edge = curve.edges[e];
  const auto from = hit_from(nodes, curve, e, -1, opposite), to = hit_from(nodes, curve, e, 1, opposite);
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
    if (const auto foot = foot_on_edge(nodes, edge, nodes.row(vertex).transpose())) feet.push_back(*foot);
  std::sort(feet.begin(), feet.end());
  std::vector<double> cuts{-1};
  for (const double foot : feet)
    if (foot > cuts.back() + projection_tolerance && foot < 1 - projection_tolerance) cuts.push_back(foot);
  cuts.push_back(1);
  return cuts;
}

int gauss_count(const Edge& edge, const Edge& opposite) {
  const int degree = edge.node_count - 1;
  return (degree + std::max(degree, opposite.node_count - 1) + 2) / 2;
}

}  // namespace

std::vector<Segment> find_segments(const Points& nodes, const Curve& multiplier, const Curve& opposite) {
  std::vector<Segment> segments;
  for (int e = 0; e < int(multiplier.edges.size()); ++e) {
    const std::vector<double> cuts = cuts_of(nodes, multiplier, e, opposite);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
      if (const auto hit = hit_from(nodes, multiplier, e, (cuts[i] + cuts[i + 1]) / 2, opposite))
        segments.push_back({e, cuts[i], cuts[i + 1], hit->edge});
  }
  return segments;
}

std::vector<ContactPoint> contact_points(const Points& nodes, const Curve& multiplier, const Curve& opposite,
                                         Integration integration, const ContactLines* lines) {
  std::vector<Segment> pieces;
  if (integration == Integration::segments) {
    pieces = find_segments(nodes, multiplier, opposite);
  } else {
    for (int e = 0; e < int(multiplier.edges.size()); ++e) pieces.push_back({e, -1, 1, -1});
  }
  std::vector<ContactPoint> points;
  for (const Segment& piece : pieces) {
    const Edge& edge = multiplier.edges[piece.edge];
    const Edge& other = opposite.edges[std::max(piece.opposite_edge, 0)];
    const LineRule rule = gauss_legendre(gauss_count(edge, other));
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double half = (piece.end - piece.begin) / 2, xi = piece.begin + half * (1 + rule.points[q]);
      const EdgePoint p = edge_point(nodes, edge, xi);
      Vec2 n = p.normal();
      if (lines && lines->normals)
        if (const auto foot = lines->multiplier.foot(piece.edge, p.position, xi))
          n = lines->multiplier.at(piece.edge, *foot).normal();
      // A segment knows its opposite edge; the whole curve is asked where a cut was merged away (or there are none).
      std::optional<Hit> hit;
      const Line line{p.position, n, deepest_overlap(multiplier, piece.edge)};
      if (piece.opposite_edge >= 0) hit = project_onto_edge(nodes, opposite, piece.opposite_edge, line);
      if (!hit) hit = project_onto_curve(nodes, opposite, line);
      if (!hit) continue;
      double gap = hit->distance;
      if (lines && lines->gap) {
        const Vec2 y = p.position + hit->distance * n;
        gap += offset(lines->opposite, hit->edge, hit->xi, y, n) -
               offset(lines->multiplier, piece.edge, xi, p.position, n);
      }
      points.push_back({.edge = piece.edge,
                        .xi = xi,
                        .ds = rule.weights[q] * half * p.jacobian(),
                        .normal = n,
                        .opposite_edge = hit->edge,
                        .eta = hit->xi,
                        .gap = gap});
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
      if (hit_from(nodes, curve, e, rule.points[q], opposite)) covered += ds;
    }
  return covered / length;
}

}  // namespace mortise
