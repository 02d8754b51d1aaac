#include "contact/coupling.hpp"

#include <algorithm>
#include <map>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "contact/multiplier_rows.hpp"
#include "contact/multiplier_space.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// Multipliers along the curve: one at each vertex, and one at each middle if the space has it.
void number_multipliers(const Curve& curve, Multipliers space, Coupling& coupling) {
  std::map<int, int> of_node;
  const auto number = [&](int node) {
    const auto [it, added] = of_node.emplace(node, int(coupling.node.size()));
    if (added) coupling.node.push_back(node);
    return it->second;
  };
  for (const Edge& edge : curve.edges) {
    const bool middle = edge.node_count == 3 && space != Multipliers::linear;
    const int start = number(edge.nodes[0]), mid = middle ? number(edge.nodes[2]) : -1;
    coupling.on_edge.push_back({start, number(edge.nodes[1]), mid});
  }
}

// What the contact points say of each multiplier before any is dropped.
struct Accumulated {
  Triplets own, opposite;  // of B's two sides, multiplier x degree of freedom
  VecX gap;                // int psi g0
  Support support;
};

Accumulated accumulate(const ContactInterface& interface, const CouplingOptions& options, const Coupling& coupling) {
  const std::vector<ContactPoint>& points = interface.points;
  const Eigen::Index count = coupling.node.size();
  Accumulated sums{{},
                   {},
                   VecX::Zero(count),
                   {.extent = VecX::Zero(count),
                    .scale = VecX::Zero(count),
                    .weight = VecX::Zero(count),
                    .lagrange = VecX::Zero(count),
                    .faced = VecX::Zero(count)}};
  sums.own.reserve(points.size() * 18);
  sums.opposite.reserve(points.size() * 18);
  for (const auto& of_edge : edge_by_edge(points)) {
    const Edge& edge = interface.multiplier.edges[of_edge[0].edge];
    const auto& multipliers = coupling.on_edge[of_edge[0].edge];
    const EdgeMultipliers space = edge_multipliers(edge, options.multipliers, of_edge);
    for (const ContactPoint& p : of_edge) {
      const Edge& other = interface.opposite.edges[p.opposite_edge];
      const EdgeShape N = edge_shape(edge.node_count, p.xi), M = edge_shape(other.node_count, p.eta);
      const Eigen::Vector3d shape = space.shape(p.xi), psi = p.dA * shape;
      const EdgeShape lagrange = edge_shape(space.count, p.xi);
      for (int i = 0; i < space.count; ++i) {
        const int a = multipliers[i];
        sums.support.extent(a) += p.ds * std::abs(lagrange.N[i]);
        sums.support.lagrange(a) += p.dA * std::abs(lagrange.N[i]);
        sums.support.scale(a) += std::abs(psi(i));
        sums.support.weight(a) += psi(i);
        sums.support.faced(a) += p.ds;
        if (options.initial_gap != InitialGap::closed) sums.gap(a) += psi(i) * p.gap;
        for (int c = 0; c < 2; ++c) {
          for (int b = 0; b < edge.node_count; ++b)
            sums.own.emplace_back(a, 2 * edge.nodes[b] + c, -psi(i) * N.N[b] * p.normal(c));
          for (int b = 0; b < other.node_count; ++b)
            sums.opposite.emplace_back(a, 2 * other.nodes[b] + c, psi(i) * M.N[b] * p.normal(c));
        }
      }
    }
  }
  return sums;
}

// Row by row: Eigen's setFromTriplets would go through all columns.
SparseRows rows_of(const std::vector<std::map<int, double>>& rows, Eigen::Index columns) {
  SparseRows B(Eigen::Index(rows.size()), columns);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    B.startVec(Eigen::Index(r));
    for (const auto& [column, value] : rows[r]) B.insertBack(Eigen::Index(r), column) = value;
  }
  B.finalize();
  return B;
}

// Curves that go all round, sector by sector, face each other in one all along.
void require_one_sector(const Mesh& mesh, const Curve& multiplier, const Curve& opposite, double covered) {
  constexpr double sliver = 1e-2;  // of the curve: normals of two meshes at its ends
  const double length = curve_length(mesh.nodes, multiplier);
  if (covered > (1 - sliver) * length || !closes_in_the_next_sector(mesh, multiplier) ||
      !closes_in_the_next_sector(mesh, opposite))
    return;
  throw InputError(worded(mesh.source, ": contact between '", mesh.boundaries[multiplier.boundary].name, "' and '",
                          mesh.boundaries[opposite.boundary].name,
                          "': both go on in the next sector, but face each other on ", covered, " of ", length,
                          "; expected cuts of the two bodies that cross contact at one place"));
}

}  // namespace

Coupling couple(const Mesh& mesh, const ContactInterface& interface, const Constraints& constraints,
                const CouplingOptions& options) {
  const Curve &multiplier = interface.multiplier, &opposite = interface.opposite;
  const std::vector<ContactPoint>& points = interface.points;
  if (points.empty())
    throw InputError(
        mesh.source + ": contact between '" + mesh.boundaries[multiplier.boundary].name + "' and '" +
        mesh.boundaries[opposite.boundary].name +
        "': the curves do not face each other anywhere, or overlap by more than half of a body's thickness" +
        (multiplier.body == opposite.body ? "; both are curves of body '" + mesh.bodies[multiplier.body] + "'" : ""));
  Coupling coupling;
  number_multipliers(multiplier, options.multipliers, coupling);
  const Accumulated sums = accumulate(interface, options, coupling);
  number_rows({mesh, interface, constraints, options.initial_gap}, sums.support, coupling);

  coupling.gap_min = coupling.gap_max = points.front().gap;
  for (const ContactPoint& p : points) {
    coupling.covered_length += p.ds;
    coupling.gap_min = std::min(coupling.gap_min, p.gap);
    coupling.gap_max = std::max(coupling.gap_max, p.gap);
  }
  require_one_sector(mesh, multiplier, opposite, coupling.covered_length);
  for (std::size_t a = 0; a < coupling.row.size(); ++a) {
    if (coupling.row[a] < 0) continue;
    coupling.gap0(coupling.row[a]) += sums.gap(a);
    coupling.scale(coupling.row[a]) += sums.support.scale(a);
  }
  std::vector<std::map<int, double>> rows(coupling.gap0.size());
  const auto add = [&](const Triplets& side) {
    for (const auto& t : side)
      if (coupling.row[t.row()] >= 0) rows[coupling.row[t.row()]][t.col()] += t.value();
    return rows_of(rows, 2 * mesh.nodes.rows());
  };
  coupling.own = add(sums.own);
  coupling.B = add(sums.opposite);
  return coupling;
}

std::vector<int> row_nodes(const Coupling& coupling) {
  std::vector<int> nodes(coupling.gap0.size(), -1);
  for (std::size_t a = 0; a < coupling.row.size(); ++a)
    if (coupling.row[a] >= 0 && nodes[coupling.row[a]] < 0) nodes[coupling.row[a]] = coupling.node[a];
  return nodes;
}

VecX multiplier_values(const Coupling& coupling, const VecX& row_values) {
  VecX values = VecX::Zero(coupling.row.size());
  for (std::size_t a = 0; a < coupling.row.size(); ++a)
    if (coupling.row[a] >= 0) values(a) = row_values(coupling.row[a]);
  return values;
}

std::map<int, Vec2> contact_forces(const SparseRows& B, const VecX& row_values) {
  std::map<int, Vec2> forces;
  for_each_entry(B, [&](int row, int column, double value) {
    forces.try_emplace(column / 2, Vec2::Zero()).first->second(column % 2) -= value * row_values(row);
  });
  return forces;
}

double interpolate(const ContactInterface& interface, const VecX& values, const Place& at) {
  const auto& on = interface.coupling.on_edge[at.edge];
  const int count = on[2] >= 0 ? interface.multiplier.edges[at.edge].node_count : 2;
  const EdgeShape s = edge_shape(count, at.xi);
  double value = 0;
  for (int i = 0; i < count; ++i) value += s.N[i] * values(on[i]);
  return value;
}

}  // namespace mortise
