#include "contact/mortar_projection.hpp"

#include <cmath>
#include <map>
#include <set>
#include <span>

#include "contact/multiplier_space.hpp"
#include "fem/edges.hpp"
#include "fem/quadrature.hpp"

namespace mortise {
namespace {

// Of each node of an edge int N dA, and that of |N|.
struct Shares {
  Eigen::Vector3d of_all = Eigen::Vector3d::Zero(), sizes = of_all;
};

Shares shares(const Points& nodes, const Edge& edge, const Model& model) {
  static const LineRule rule = gauss_legendre(8);
  Shares whole;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const EdgePoint at = edge_point(nodes, edge, rule.points[q]);
    const EdgeShape shape = edge_shape(edge.node_count, rule.points[q]);
    const double dA = rule.weights[q] * at.jacobian() * model.depth(at.position.x());
    for (int a = 0; a < edge.node_count; ++a) {
      whole.of_all(a) += dA * shape.N[a];
      whole.sizes(a) += dA * std::abs(shape.N[a]);
    }
  }
  return whole;
}

constexpr double negligible = 1e-6;  // part of a share: round-off

// Nodes of `edge` that follow. Where the other side ends on it, duals of the part that is faced continue the other
// side's displacement: of a block on a longer one that is right to 1 % of its energy down to a tenth of a node's share,
// below which the node is better left free (0.2 %), as what it continues is far from it.
void add_following(const Edge& edge, const Shares& whole, std::span<const ContactPoint> points, std::set<int>& follow) {
  constexpr double least = 0.1;
  for (int a = 0; a < edge.node_count; ++a) {
    double part = 0;
    for (const ContactPoint& p : points) part += p.dA * edge_shape(edge.node_count, p.xi).N[a];
    if (whole.of_all(a) > negligible * whole.sizes(a) && part > least * whole.of_all(a)) follow.insert(edge.nodes[a]);
  }
}

// On the axis of rings a quadratic edge's end has no multiplier, as int N r ds = 0: it follows the other side's end
// there, and no force of a constant stress goes that way.
void add_axis_end(const Points& nodes, const Edge& edge, const Shares& whole, const Curve& opposite,
                  std::vector<TiedNode>& tied) {
  for (const int a : {0, 1}) {
    const Vec2 x = nodes.row(edge.nodes[a]);
    if (std::abs(whole.of_all(a)) > negligible * whole.sizes(a)) continue;
    for (const int end : {opposite.edges.front().nodes[0], opposite.edges.back().nodes[1]})
      if ((nodes.row(end).transpose() - x).norm() < 0.1 * edge_length(nodes, edge))
        tied.push_back({edge.nodes[a], {{end, 1.0}}, 0, edge.nodes[2]});
  }
}

}  // namespace

std::vector<TiedNode> mortar_projection(const Points& nodes, const Curve& multiplier, const Curve& opposite,
                                        const Model& model) {
  ContactInterface edges{.multiplier = multiplier, .opposite = opposite, .geometry = {}, .points = {}, .coupling = {}};
  edges.geometry.model = model;
  const std::vector<ContactPoint> points = contact_points(nodes, edges, Integration::segments);
  std::map<int, std::map<int, double>> M;
  std::map<int, int> beside;
  std::set<int> follow;
  std::vector<TiedNode> tied;
  for (const auto& of_edge : edge_by_edge(points)) {
    const Edge& edge = multiplier.edges[of_edge[0].edge];
    const EdgeMultipliers space = edge_multipliers(edge, Multipliers::dual, of_edge);
    const Shares whole = shares(nodes, edge, model);
    add_following(edge, whole, of_edge, follow);
    if (model.axisymmetric()) add_axis_end(nodes, edge, whole, opposite, tied);
    for (int a = 0; a < edge.node_count; ++a) beside[edge.nodes[a]] = edge.nodes[edge.node_count == 3 ? 2 : 1 - a];
    for (const ContactPoint& p : of_edge) {
      const Eigen::Vector3d psi = space.shape(p.xi);
      const Edge& other = opposite.edges[p.opposite_edge];
      const EdgeShape shape = edge_shape(other.node_count, p.eta);
      for (int a = 0; a < space.count; ++a)
        for (int c = 0; c < other.node_count; ++c) M[edge.nodes[a]][other.nodes[c]] += p.dA * psi(a) * shape.N[c];
    }
  }
  for (const auto& [node, row] : M) {
    if (!follow.contains(node)) continue;
    double D = 0, size = 0;  // the opposite side's shape functions add up to 1
    for (const auto& [other, entry] : row) {
      D += entry;
      size += std::abs(entry);
    }
    if (!(D > negligible * size)) continue;
    TiedNode& one = tied.emplace_back(TiedNode{node, {}, D, beside[node]});
    for (const auto& [other, entry] : row)
      if (std::abs(entry) > 1e-14 * size) one.weights.emplace_back(other, entry / D);
  }
  return tied;
}

}  // namespace mortise
