#include "contact/surface_layer.hpp"

#include <array>

#include "fem/edges.hpp"

namespace mortise {

Triplets surface_layer(const ContactInterface& interface) {
  Triplets rows;
  for (std::size_t q = 0; q < interface.points.size(); ++q) {
    const ContactPoint& point = interface.points[q];
    const auto& multipliers = interface.coupling.on_edge[point.edge];
    const int count = multipliers[2] >= 0 ? 3 : 2;
    const EdgeShape shape = edge_shape(count, point.xi);
    for (int i = 0; i < count; ++i)
      if (const int row = interface.coupling.row[multipliers[i]]; row >= 0)
        rows.emplace_back(row, int(q), point.dA * shape.N[i]);
  }
  return rows;
}

MatX less_layer(const ContactInterface& interface, const std::vector<char>& closed, MatX opened) {
  const std::vector<ContactPoint>& points = interface.points;
  MatX sum = MatX::Zero(Eigen::Index(closed.size()), opened.cols());
  VecX weight = VecX::Zero(Eigen::Index(closed.size()));
  const auto hats = [](const ContactPoint& p) { return std::array{(1 - p.xi) / 2, (1 + p.xi) / 2}; };
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const int end : {0, 1}) {
      const double part = points[i].dA * hats(points[i])[end];
      weight(points[i].edge + end) += part;
      sum.row(points[i].edge + end) += part * opened.row(Eigen::Index(i));
    }
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const int end : {0, 1})
      if (const int vertex = points[i].edge + end; closed[vertex])
        opened.row(Eigen::Index(i)) -= hats(points[i])[end] / weight(vertex) * sum.row(vertex);
  return opened;
}

}  // namespace mortise
