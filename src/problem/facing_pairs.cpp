#include "problem/facing_pairs.hpp"

#include <algorithm>
#include <set>

#include "contact/projection.hpp"
#include "fem/edges.hpp"
#include "mesh/body_points.hpp"
#include "mesh/box_index.hpp"

namespace mortise {
namespace {

Box box_of(const Points& nodes, const Curve& curve) {
  Box box;
  for (const int node : curve_nodes(curve)) box.extend(Vec2(nodes.row(node).transpose()));
  return box;
}

double mean_edge(const Points& nodes, const Curve& curve) {
  return curve_length(nodes, curve) / double(curve.edges.size());
}

bool faces(const Points& nodes, const Curve& from, const Curve& to, double within) {
  for (int e = 0; e < int(from.edges.size()); ++e)
    for (const double xi : {-0.5, 0.0, 0.5}) {
      const auto hit = project_onto_curve(nodes, to, line_from(nodes, from, e, xi));
      if (hit && std::abs(hit->distance) <= within) return true;
    }
  return false;
}

}  // namespace

std::vector<std::array<int, 2>> facing_pairs(const Mesh& mesh, const std::map<int, Curve>& curves,
                                             const std::array<std::vector<int>, 2>& sides,
                                             const std::optional<double>& within) {
  const Points& nodes = mesh.nodes;
  const std::vector<int> bonded = bonded_to(mesh, body_points(mesh));
  std::vector<Box> boxes;
  for (const int boundary : sides[1]) boxes.push_back(box_of(nodes, curves.at(boundary)));
  const BoxIndex index(boxes);
  std::vector<std::array<int, 2>> pairs;
  std::set<std::pair<int, int>> known;
  for (const int first : sides[0]) {
    const Curve& curve = curves.at(first);
    const double edge = mean_edge(nodes, curve), reach = within.value_or(edge / 2);
    const Box box = box_of(nodes, curve), wide(box.min() - Vec2(reach, reach), box.max() + Vec2(reach, reach));
    for (const int k : index.meeting(wide)) {
      const int second = sides[1][k];
      const Curve& other = curves.at(second);
      if (bonded[curve.body] == bonded[other.body] || known.contains(std::minmax(first, second))) continue;
      const double limit = within.value_or(std::min(edge, mean_edge(nodes, other)) / 2);
      if (!faces(nodes, curve, other, limit) && !faces(nodes, other, curve, limit)) continue;
      known.insert(std::minmax(first, second));
      pairs.push_back({first, second});
    }
  }
  return pairs;
}

}  // namespace mortise
