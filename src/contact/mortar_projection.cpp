#include "contact/mortar_projection.hpp"

#include <cmath>
#include <map>
#include <span>

#include "contact/multiplier_space.hpp"
#include "fem/edges.hpp"

namespace mortise {

std::vector<TiedNode> mortar_projection(const Points& nodes, const Curve& multiplier, const Curve& opposite,
                                        const Model& model) {
  ContactInterface edges{.multiplier = multiplier, .opposite = opposite, .geometry = {}, .points = {}, .coupling = {}};
  edges.geometry.model = model;
  const std::vector<ContactPoint> points = contact_points(nodes, edges, Integration::segments);
  std::map<int, std::map<int, double>> M;
  std::map<int, int> beside;
  for (const auto& of_edge : edge_by_edge(points)) {
    const Edge& edge = multiplier.edges[of_edge[0].edge];
    const EdgeMultipliers space = edge_multipliers(edge, Multipliers::dual, of_edge);
    for (int a = 0; a < edge.node_count; ++a) beside[edge.nodes[a]] = edge.nodes[edge.node_count == 3 ? 2 : 1 - a];
    for (const ContactPoint& p : of_edge) {
      const Eigen::Vector3d psi = space.shape(p.xi);
      const Edge& other = opposite.edges[p.opposite_edge];
      const EdgeShape shape = edge_shape(other.node_count, p.eta);
      for (int a = 0; a < space.count; ++a)
        for (int c = 0; c < other.node_count; ++c) M[edge.nodes[a]][other.nodes[c]] += p.dA * psi(a) * shape.N[c];
    }
  }
  std::vector<TiedNode> tied;
  for (const auto& [node, row] : M) {
    double D = 0, size = 0;  // the opposite side's shape functions add up to 1
    for (const auto& [other, entry] : row) {
      D += entry;
      size += std::abs(entry);
    }
    if (!(D > 1e-6 * size)) continue;
    TiedNode& one = tied.emplace_back(TiedNode{node, {}, D, beside[node]});
    for (const auto& [other, entry] : row)
      if (std::abs(entry) > 1e-14 * size) one.weights.emplace_back(other, entry / D);
  }
  return tied;
}

}  // namespace mortise
