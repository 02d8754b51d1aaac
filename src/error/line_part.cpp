#include "error/line_part.hpp"

#include <cmath>

#include "contact/surface_layer.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

bool among(const std::array<Eigen::Index, 2>& edges, Eigen::Index e) { return e == edges[0] || e == edges[1]; }

std::vector<char> pressed(const PressureLine& line) {
  std::vector<char> vertices = line.loaded;
  for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] &= line.p(Eigen::Index(i)) != 0;
  return vertices;
}

}  // namespace

std::array<Eigen::Index, 2> edges_at(const PressureLine& line, Eigen::Index e) {
  const Eigen::Index edges = line.p.size() - 1;
  const bool loaded_before = std::abs(line.p(e)) > std::abs(line.p(e + 1));
  Eigen::Index within = loaded_before ? e - 1 : e + 1;
  if (line.closed) within = (within + edges) % edges;
  return {e, within >= 0 && within < edges && line.faced[within] ? within : -1};
}

MatX openings(const ContactPair& pair, const MatX& z) {
  MatX opened(Eigen::Index(pair.points.size()), z.cols());
  for (Eigen::Index i = 0; i < opened.rows(); ++i) {
    const ContactPoint& point = pair.points[i];
    const Edge &own = pair.multiplier.edges[point.edge], &other = pair.opposite.edges[point.opposite_edge];
    const EdgeShape N = edge_shape(own.node_count, point.xi), M = edge_shape(other.node_count, point.eta);
    opened.row(i).setZero();
    for (int c = 0; c < 2; ++c) {
      for (int a = 0; a < own.node_count; ++a) opened.row(i) -= point.normal(c) * N.N[a] * z.row(2 * own.nodes[a] + c);
      for (int a = 0; a < other.node_count; ++a)
        opened.row(i) += point.normal(c) * M.N[a] * z.row(2 * other.nodes[a] + c);
    }
  }
  return opened;
}

LinePart line_part(const ContactPair& pair, const PressureLine& line, const LineError& local, MatX opened) {
  if (pair.spec.stiffness) opened = less_layer(pair, pressed(line), std::move(opened));
  const Eigen::Index count = line.p.size(), functionals = opened.cols();
  LinePart part{.vertices = MatX::Zero(count, functionals),
                .borders = MatX::Zero(Eigen::Index(local.borders.size()), functionals)};
  for (Eigen::Index i = 0; i < opened.rows(); ++i) {
    const ContactPoint& point = pair.points[i];
    const double depth = point.dA / point.ds;
    for (const int end : {0, 1}) {
      const Eigen::Index vertex = point.edge + end;
      if (local.border[vertex] || !line.loaded[vertex]) continue;
      const double hat = (end == 0 ? 1 - point.xi : 1 + point.xi) / 2;
      part.vertices.row(vertex) += hat * depth * point.dA * opened.row(i).cwiseAbs2();
    }
  }
  part.vertices = local.whole().asDiagonal() * part.vertices.cwiseSqrt();
  for (std::size_t b = 0; b < local.borders.size(); ++b) {
    const std::array<Eigen::Index, 2> edges = edges_at(line, local.borders[b].edge);
    double force = 0;
    Eigen::RowVectorXd most = Eigen::RowVectorXd::Zero(functionals);
    for (Eigen::Index i = 0; i < opened.rows(); ++i) {
      const ContactPoint& point = pair.points[i];
      if (!among(edges, point.edge)) continue;
      force +=
          point.dA * std::abs((1 - point.xi) / 2 * line.p(point.edge) + (1 + point.xi) / 2 * line.p(point.edge + 1));
      most = most.cwiseMax(opened.row(i).cwiseAbs());
    }
    part.borders.row(Eigen::Index(b)) = force * most;
  }
  return part;
}

}  // namespace mortise
