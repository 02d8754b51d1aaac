#include "contact/pressure_norm.hpp"

#include <algorithm>

#include "contact/multiplier_space.hpp"
#include "fem/edges.hpp"

namespace mortise {

SparseMatrix pressure_norm(const Points& nodes, const ContactInterface& interface, Multipliers space) {
  const std::vector<ContactPoint>& points = interface.points;
  const Coupling& coupling = interface.coupling;
  Triplets entries;
  for (auto first = points.begin(); first != points.end();) {
    const auto last = std::find_if(first, points.end(), [&](const ContactPoint& p) { return p.edge != first->edge; });
    const Edge& edge = interface.multiplier.edges[first->edge];
    const auto& on = coupling.on_edge[first->edge];
    const EdgeMultipliers shapes = edge_multipliers(edge, space, {first, last});
    const double h = edge_length(nodes, edge);
    for (; first != last; ++first) {
      const Eigen::Vector3d psi = shapes.shape(first->xi);
      for (int i = 0; i < shapes.count; ++i)
        for (int j = 0; j < shapes.count; ++j) {
          const int a = coupling.row[on[i]], b = coupling.row[on[j]];
          if (a >= 0 && b >= 0) entries.emplace_back(a, b, h * first->dA * psi(i) * psi(j));
        }
    }
  }
  return filled(coupling.gap0.size(), coupling.gap0.size(), entries);
}

}  // namespace mortise
