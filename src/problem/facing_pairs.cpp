#include "problem/facing_pairs.hpp"

#include <algorithm>
#include <set>

#include "contact/curve_resolution.hpp"
#include "contact/projection.hpp"
#include "fem/edges.hpp"
#include "mesh/body_points.hpp"
#include "mesh/box_index.hpp"

namespace mortise {
namespace {

// Holds the whole curve: a 3-node edge lies in the triangle of its ends and where the tangents there meet.
Box box_of(const Points& nodes, const Curve& curve) {
  Box box;
  const auto at = [&](int node) -> Vec2 { return nodes.row(node).transpose(); };
  for (const Edge& edge : curve.edges) {
    const Vec2 start = at(edge.nodes[0]), end = at(edge.nodes[1]);
    box.extend(start).extend(end);
    if (edge.node_count == 3) box.extend(Vec2(2 * at(edge.nodes[2]) - (start + end) / 2));
  }
  return box;
}

struct Candidate {
  const Curve& curve;
  double edge;     // mean length
  double sagitta;  // the largest, where it counts
  Box box;
};

Candidate candidate(const Points& nodes, const Curve& curve, const Nearness& near) {
  return {curve, curve_length(nodes, curve) / double(curve.edges.size()),
          near.as_one_curve ? std::ranges::max(sagittas(nodes, curve)) : 0, box_of(nodes, curve)};
}

double limit(const Nearness& near, const Candidate& one, const Candidate& other) {
  if (near.within) return *near.within;
  if (near.as_one_curve) return one_curve_gap(one.sagitta, other.sagitta, std::max(one.edge, other.edge));
  return std::min(one.edge, other.edge) / 2;
}

// Cosine between a normal and that of what it meets, against one another. Sides nearer to a right angle, as a side that
// leans over beside its foot, close only as they slide ten times as far, or turn: not within small displacements.
constexpr double least_cosine = 0.1;

bool faces(const Points& nodes, const Candidate& from, const Candidate& to, double within) {
  const double reach = within + 1e-6 * to.edge;  // and round-off
  for (int e = 0; e < int(from.curve.edges.size()); ++e)
    for (const double xi : {-0.5, 0.0, 0.5}) {
      const Line line = line_from(nodes, from.curve, e, xi);
      if (to.box.squaredExteriorDistance(line.x) > reach * reach) continue;
      const auto hit = project_onto_curve(nodes, to.curve, line);
      if (!hit || std::abs(hit->distance) > within) continue;
      if (-line.n.dot(edge_point(nodes, to.curve.edges[hit->edge], hit->xi).normal()) > least_cosine) return true;
    }
  return false;
}

}  // namespace

std::vector<std::array<int, 2>> facing_pairs(const Mesh& mesh, const std::map<int, Curve>& curves,
                                             const std::array<std::vector<int>, 2>& sides, const Nearness& near) {
  const Points& nodes = mesh.nodes;
  const std::vector<int> bonded = bonded_to(mesh, body_points(mesh));
  std::vector<Candidate> others;
  std::vector<Box> boxes;
  for (const int boundary : sides[1]) {
    others.push_back(candidate(nodes, curves.at(boundary), near));
    boxes.push_back(others.back().box);
  }
  if (others.empty()) return {};
  Candidate largest = others.front();  // of sizes
  for (const Candidate& other : others) {
    largest.edge = std::max(largest.edge, other.edge);
    largest.sagitta = std::max(largest.sagitta, other.sagitta);
  }
  const BoxIndex index(boxes);
  std::vector<std::array<int, 2>> pairs;
  std::set<std::pair<int, int>> tried;
  for (const int first : sides[0]) {
    const Candidate own = candidate(nodes, curves.at(first), near);
    const double reach = limit(near, own, largest);
    const Box wide(own.box.min() - Vec2(reach, reach), own.box.max() + Vec2(reach, reach));
    for (const int k : index.meeting(wide)) {
      const int second = sides[1][k];
      const Candidate& other = others[k];
      if (bonded[own.curve.body] == bonded[other.curve.body] || !tried.insert(std::minmax(first, second)).second)
        continue;
      const double within = limit(near, own, other);
      if (faces(nodes, own, other, within) || faces(nodes, other, own, within)) pairs.push_back({first, second});
    }
  }
  return pairs;
}

}  // namespace mortise
