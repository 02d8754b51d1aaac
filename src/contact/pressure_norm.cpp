#include "contact/pressure_norm.hpp"

#include <algorithm>

#include "contact/multiplier_space.hpp"
#include "fem/edges.hpp"

namespace mortise {

SparseMatrix pressure_norm(const Points& nodes, const ContactInterface& interface, Multipliers space) {
  const Coupling& coupling = interface.coupling;
  Triplets entries;
  for (const auto& points : edge_by_edge(interface.points)) {
    const Edge& edge = interface.multiplier.edges[points[0].edge];
    const auto& on = coupling.on_edge[points[0].edge];
    const EdgeMultipliers shapes = edge_multipliers(edge, space, points);
    const double h = edge_length(nodes, edge);
    for (const ContactPoint& p : points) {
      const Eigen::Vector3d psi = shapes.shape(p.xi);
      for (int i = 0; i < shapes.count; ++i)
        for (int j = 0; j < shapes.count; ++j) {
          const int a = coupling.row[on[i]], b = coupling.row[on[j]];
          if (a >= 0 && b >= 0) entries.emplace_back(a, b, h * p.dA * psi(i) * psi(j));
        }
    }
  }
  return filled(coupling.gap0.size(), coupling.gap0.size(), entries);
}

}  // namespace mortise
