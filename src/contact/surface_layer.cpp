#include "contact/surface_layer.hpp"

#include <algorithm>
#include <array>

#include "contact/multiplier_space.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

constexpr double unfaced = 1e-9;  // of the largest diagonal: what holds a compression that no point sees

}  // namespace

SurfaceLayer surface_layer(const ContactInterface& interface, Multipliers space, double stiffness) {
  const Coupling& coupling = interface.coupling;
  SurfaceLayer layer;
  VecX diagonal = VecX::Zero(Eigen::Index(coupling.node.size()));
  const std::vector<ContactPoint>& points = interface.points;
  for (auto first = points.begin(); first != points.end();) {
    const auto last = std::find_if(first, points.end(), [&](const ContactPoint& p) { return p.edge != first->edge; });
    const auto& on = coupling.on_edge[first->edge];
    const EdgeMultipliers functions = edge_multipliers(interface.multiplier.edges[first->edge], space, {first, last});
    for (; first != last; ++first) {
      const EdgeShape shape = edge_shape(functions.count, first->xi);
      const Eigen::Vector3d psi = first->dA * functions.shape(first->xi);
      for (int i = 0; i < functions.count; ++i) {
        const double weight = stiffness * first->dA * shape.N[i];
        diagonal(on[i]) += weight * shape.N[i];
        for (int j = 0; j < functions.count; ++j) {
          if (on[j] <= on[i]) layer.stiffness.emplace_back(on[i], on[j], weight * shape.N[j]);
          if (const int row = coupling.row[on[i]]; row >= 0) layer.rows.emplace_back(row, on[j], psi(i) * shape.N[j]);
        }
      }
    }
  }
  for (int b = 0; b < int(diagonal.size()); ++b) layer.stiffness.emplace_back(b, b, unfaced * diagonal.maxCoeff());
  return layer;
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
