#include <algorithm>
#include <cmath>
#include <map>
#include <set>

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
  std::set<std::pair<int, int>> faced;  // boundaries that face each other there
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

// A point of an edge that has come into another piece.
struct Inside {
  EdgeAndPiece of;
  double xi;
  EdgePoint at;
  OutlinePlace nearest;
};

// How far the point has come in; 0 where it has not, or a pair stands there.
double depth_of(const Moved& all, const Inside& in) {
  const auto& [b, deformed, largest] = all;
  const auto& [of, xi, at, place] = in;
  if (nearly_paired(b, of.edge, place.edge)) return 0;
  const Vec2 moved = displaced(deformed, b.outline, of.edge, xi) - displaced(deformed, b.outline, place.edge, place.xi);
  const Vec2 from = edge_point(b.outline.nodes, deformed.edges[of.edge].edge, xi).position;
  const double depth = -place.distance - std::max(0., -nearest(b.outline, of.piece, from).distance);
  return depth > of_relative * moved.norm() + of_largest * largest ? depth : 0;
}

template <typename Work>
void for_points_inside(const Moved& all, const std::vector<EdgeAndPiece>& some, Work work) {
  static const LineRule rule = gauss_legendre(3);
  for (const EdgeAndPiece& of : some)
    if (edge_box(all.deformed, of.edge, 0).intersects(all.deformed.pieces[of.piece].box))
      for (const double xi : rule.points) {
        const EdgePoint at = edge_point(all.deformed.nodes, all.deformed.edges[of.edge].edge, xi);
        const OutlinePlace place = nearest(all.deformed, of.piece, at.position);
        if (-place.distance > of_largest * all.largest) work(Inside{of, xi, at, place});
      }
}

// By pieces: how deep they lie in one another where a pair stands between them, as its gap is not the drawn one or it
// gives way.
std::map<std::pair<int, int>, double> depths_in_pairs(const Moved& all, const std::vector<EdgeAndPiece>& some) {
  std::map<std::pair<int, int>, double> depths;
  for_points_inside(all, some, [&](const Inside& in) {
    if (!nearly_paired(all.b, in.of.edge, in.nearest.edge)) return;
    double& depth = depths[std::minmax(all.deformed.edges[in.of.edge].piece, in.of.piece)];
    depth = std::max(depth, -in.nearest.distance);
  });
  return depths;
}

// Whether curves of one pair are near a point: what lies `depth` in the other body at these is nearer to another side
// of it at its corners, and on a line of symmetry. There a round of radius R lies deeper than beyond `depth` from that
// line, where the pair is nearest, by depth^2 / 2 R: less than twice as deep up to 2 R.
bool is_beside_pair(const Moved& all, const Inside& in, double depth) {
  const Outline& o = all.deformed;
  const double reach = 2 * depth;
  const Box near(in.at.position - Vec2(reach, reach), in.at.position + Vec2(reach, reach));
  const PieceOutline &own = o.pieces[o.edges[in.of.edge].piece], &other = o.pieces[in.of.piece];
  const std::vector<int> others = other.edges.meeting(near);
  return std::ranges::any_of(own.edges.meeting(near), [&](int e) {
    return std::ranges::any_of(others, [&](int f) { return paired(all.b, own.first + e, other.first + f); });
  });
}

std::string line(const AuditedBodies& b, int first, int second, const Crossing& c, double largest) {
  return worded(two_bodies(b.mesh, first, second), " pass through one another by ", c.depth, " (",
                percent(c.depth / largest), " of the largest displacement) ", near_point(middle_of(b, c.edges)), " (",
                name_of(b, c.edges), ", ", name_of(b, c.others),
                "), and no contact pair keeps them apart there: the results are not those of two bodies; ",
                advice(b, c.edges, c.others));
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

void add(const Moved& all, const Inside& in, double depth, std::map<std::pair<int, int>, Crossing>& crossings) {
  const Outline& deformed = all.deformed;
  const int edge = in.of.edge, other = in.nearest.edge;
  const int body = deformed.edges[edge].body, other_body = deformed.pieces[in.of.piece].body;
  Crossing& c = crossings[std::minmax(body, other_body)];
  c.depth = std::max(c.depth, depth);
  c.edges.push_back(body > other_body ? other : edge);
  c.others.push_back(body > other_body ? edge : other);
  if (!face_each_other(in.at.normal(), in.nearest)) return;
  for (const int first : all.b.names[edge])
    for (const int second : all.b.names[other]) c.faced.insert(std::minmax(first, second));
}

// By bodies.
std::map<std::pair<int, int>, Crossing> crossings_of(const Moved& all, const std::vector<EdgeAndPiece>* some) {
  const std::vector<EdgeAndPiece> near = some ? *some : meeting(all.deformed, 0);
  std::vector<std::pair<Inside, double>> found;  // and their depths
  for_points_inside(all, near, [&](const Inside& in) {
    if (const double depth = depth_of(all, in); depth > 0) found.emplace_back(in, depth);
  });
  std::map<std::pair<int, int>, Crossing> crossings;
  if (found.empty()) return crossings;
  const auto in_pairs = depths_in_pairs(all, some ? meeting(all.deformed, 0) : near);
  for (const auto& [in, depth] : found) {
    const auto in_pair = in_pairs.find(std::minmax(all.deformed.edges[in.of.edge].piece, in.of.piece));
    if (in_pair == in_pairs.end() || !is_beside_pair(all, in, in_pair->second)) add(all, in, depth, crossings);
  }
  return crossings;
}

bool means(const PatternSides& pattern, int first, int second) {
  return std::ranges::binary_search(pattern[0], first) && std::ranges::binary_search(pattern[1], second);
}

// Of boundaries that have gone through one another those that a pattern would have paired, had they been drawn nearer.
std::vector<KnownPair> missed_pairs(const Problem& p, const std::set<std::pair<int, int>>& faced) {
  std::vector<KnownPair> missed;
  for (const auto& [first, second] : faced)
    if (std::ranges::any_of(p.patterns, [&](const PatternSides& pattern) {
          return means(pattern, first, second) || means(pattern, second, first);
        }))
      missed.push_back(
          {.curves = {p.mesh.boundaries[first].name, p.mesh.boundaries[second].name}, .first_is_multiplier = false});
  return missed;
}

}  // namespace

std::vector<EdgeAndPiece> may_cross(const AuditedBodies& b, double largest) {
  const double moved = 2 * largest;  // both components, and a point between nodes more than these
  std::vector<EdgeAndPiece> list = meeting(b.outline, 5 * moved);
  std::erase_if(list, [&](const EdgeAndPiece& of) { return stays_apart(b, of, moved); });
  return list;
}

std::vector<std::string> crossing_lines(const AuditedBodies& b, const Results& r, const std::vector<EdgeAndPiece>* some,
                                        std::vector<KnownPair>& missed) {
  if (!r.solution.u.allFinite() || (some && some->empty())) return {};
  const double largest = largest_entry(r.solution.u);
  const Outline deformed = outline(
      b.boundary, r.problem.mesh.nodes + Eigen::Map<const Points>(r.solution.u.data(), r.problem.mesh.nodes.rows(), 2));
  std::vector<std::string> lines;
  for (const auto& [bodies, c] : crossings_of({b, deformed, largest}, some)) {
    lines.push_back(line(b, bodies.first, bodies.second, c, largest));
    std::ranges::move(missed_pairs(r.problem, c.faced), std::back_inserter(missed));
  }
  return lines;
}

}  // namespace mortise
