#include "fem/arc_length.hpp"

#include <algorithm>
#include <cmath>

namespace mortise {
namespace {

// Where an edge passes through a place on it: Newton's method for (place - p(xi)) . tangent = 0, from the chord.
double xi_of(const Points& nodes, const Edge& edge, const Vec2& place) {
  const Vec2 start = nodes.row(edge.nodes[0]), chord = nodes.row(edge.nodes[1]).transpose() - start;
  double xi = 2 * (place - start).dot(chord) / chord.squaredNorm() - 1;
  for (int step = 0; step < 20; ++step) {
    const EdgePoint p = edge_point(nodes, edge, xi);
    const double change = (place - p.position).dot(p.tangent) / p.tangent.squaredNorm();
    xi += change;
    if (std::abs(change) < 1e-15) break;
  }
  return std::clamp(xi, -1.0, 1.0);
}

}  // namespace

ArcLength::ArcLength(const Points& nodes, const Curve& curve)
    : edges_(curve.edges), before_{0}, backwards_(runs_backwards(nodes, curve)) {
  const std::vector<int> along = curve_nodes(curve);
  std::unordered_map<int, int> own;
  nodes_.resize(Eigen::Index(along.size()), 2);
  for (int i = 0; i < int(along.size()); ++i) {
    own[along[i]] = i;
    nodes_.row(i) = nodes.row(along[i]);
  }
  for (Edge& edge : edges_) {
    for (int a = 0; a < edge.node_count; ++a) edge.nodes[a] = own.at(edge.nodes[a]);
    before_.push_back(before_.back() + edge_length(nodes_, edge));
  }
  for (std::size_t e = 0; e < edges_.size(); ++e)
    for (int a = 0; a < edges_[e].node_count; ++a)
      at_node_.try_emplace(curve.edges[e].nodes[a], at(int(e), xi_of_node(a)));
}

double ArcLength::at(int edge, double xi) const {
  const double along = xi >= 1 ? before_[edge + 1] : before_[edge] + length_to(nodes_, edges_[edge], xi);
  return backwards_ ? before_.back() - along : along;
}

double ArcLength::at(int edge, const Vec2& place) const { return at(edge, xi_of(nodes_, edges_[edge], place)); }

}  // namespace mortise
