#include "contact/nodal_transfer.hpp"

#include <map>

#include "fem/quadrature.hpp"

namespace mortise {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

// From each node of the curve, along the mean of the normals of the edges that meet there.
std::map<int, Line> nodal_lines(const Mesh& mesh, const Curve& curve) {
  std::map<int, Line> lines;
  for (int e = 0; e < int(curve.edges.size()); ++e)
    for (std::size_t a = 0; a < std::size_t(curve.edges[e].node_count); ++a) {
      const Line line = line_from(mesh.nodes, curve, e, a == 0 ? -1 : a == 1 ? 1 : 0);
      const auto [it, added] = lines.emplace(curve.edges[e].nodes[a], line);
      if (!added) it->second.n += line.n;
    }
  for (auto& [node, line] : lines) line.n.normalize();
  return lines;
}

// Place of the curve that a node of the other curve faces.
std::optional<Hit> place_facing(const Mesh& mesh, const Curve& curve, const Line& line) {
  if (const auto hit = project_onto_curve(mesh.nodes, curve, line)) return hit;
  for (int e = 0; e < int(curve.edges.size()); ++e)
    for (const double xi : {-1.0, 1.0}) {
      const EdgePoint end = edge_point(mesh.nodes, curve.edges[std::size_t(e)], xi);
      if ((end.position - line.x).norm() < 0.2 * end.jacobian()) return Hit{e, xi, 0};
    }
  return {};
}

// -B_multiplier I u, with I u the opposite side's displacement at the nodes of the multiplier side.
void add_displacements(const Mesh& mesh, const Curve& multiplier, const Curve& opposite, const SparseMatrix& B,
                       Triplets& entries) {
  for (const auto& [node, line] : nodal_lines(mesh, multiplier)) {
    const auto hit = place_facing(mesh, opposite, line);
    if (!hit) continue;
    const Edge& edge = opposite.edges[std::size_t(hit->edge)];
    const EdgeShape s = edge_shape(edge.node_count, hit->xi);
    for (int c = 0; c < 2; ++c)
      for (SparseMatrix::InnerIterator it(B, 2 * node + c); it; ++it)
        for (std::size_t b = 0; b < std::size_t(edge.node_count); ++b)
          entries.emplace_back(int(it.row()), 2 * edge.nodes[b] + c, -it.value() * s.N[b]);
  }
}

// int N_b n sum_k N_k psi(x_k) over the opposite side, n that of the multiplier side.
void add_pressures(const Mesh& mesh, const Curve& multiplier, const Curve& opposite, const Coupling& coupling,
                   Triplets& entries) {
  std::map<int, std::vector<std::pair<int, double>>> at_node;  // node -> rows and psi there
  for (const auto& [node, line] : nodal_lines(mesh, opposite)) {
    const auto hit = place_facing(mesh, multiplier, line);
    if (!hit) continue;
    const auto& on = coupling.on_edge[std::size_t(hit->edge)];
    const int count = on[2] >= 0 ? 3 : 2;
    const EdgeShape psi = edge_shape(count, hit->xi);
    for (std::size_t a = 0; a < std::size_t(count); ++a)
      if (const int row = coupling.row[std::size_t(on[a])]; row >= 0) at_node[node].emplace_back(row, psi.N[a]);
  }
  const LineRule rule = gauss_legendre(4);
  for (const Edge& edge : opposite.edges)
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const EdgePoint p = edge_point(mesh.nodes, edge, rule.points[q]);
      const EdgeShape s = edge_shape(edge.node_count, rule.points[q]);
      const Vec2 force = -rule.weights[q] * p.jacobian() * p.normal();
      for (std::size_t k = 0; k < std::size_t(edge.node_count); ++k)
        for (const auto& [row, psi] : at_node[edge.nodes[k]])
          for (std::size_t b = 0; b < std::size_t(edge.node_count); ++b)
            for (int c = 0; c < 2; ++c)
              entries.emplace_back(row, 2 * edge.nodes[b] + c, psi * s.N[k] * s.N[b] * force(c));
    }
}

}  // namespace

void transfer_by_nodes(const Mesh& mesh, const Curve& multiplier, const Curve& opposite, Coupling& coupling) {
  Triplets own;  // the multiplier side's columns
  for (const int node : curve_nodes(multiplier))
    for (int c = 0; c < 2; ++c)
      for (SparseMatrix::InnerIterator it(coupling.B, 2 * node + c); it; ++it)
        own.emplace_back(int(it.row()), 2 * node + c, it.value());
  Triplets gaps = own, loads = own;
  add_displacements(mesh, multiplier, opposite, coupling.B, gaps);
  add_pressures(mesh, multiplier, opposite, coupling, loads);
  coupling.loads.resize(coupling.B.rows(), coupling.B.cols());
  coupling.loads.setFromTriplets(loads.begin(), loads.end());
  coupling.B.setFromTriplets(gaps.begin(), gaps.end());
}

}  // namespace mortise
