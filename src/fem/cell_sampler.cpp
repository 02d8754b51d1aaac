#include "fem/cell_sampler.hpp"

#include <Eigen/LU>

namespace mortise {

NodalFields by_node(const MatX& fields) {
  const Eigen::Index nodes = fields.rows() / 2, count = fields.cols();
  NodalFields u(nodes, 2 * count);
  for (Eigen::Index k = 0; k < count; ++k)
    for (Eigen::Index i = 0; i < nodes; ++i) {
      u(i, k) = fields(2 * i, k);
      u(i, count + k) = fields(2 * i + 1, k);
    }
  return u;
}

Eigen::Index components(const std::vector<ElasticLaw>& laws) { return laws.front().model.axisymmetric() ? 4 : 3; }

Vec4 all_components(const ElasticLaw& law, const Eigen::RowVectorXd& s, Eigen::Index first, Eigen::Index count) {
  const double s33 = count == 4 ? s(first + 3) : law.out_of_plane.dot(s.segment<3>(first));
  return {s(first), s(first + 1), s33, s(first + 2)};
}

CellSampler::CellSampler(const Mesh& mesh, const std::vector<ElasticLaw>& laws, const MatX& fields)
    : stresses(components(laws) * fields.cols()),
      mesh_(mesh),
      laws_(laws),
      u_(by_node(fields)),
      count_(fields.cols()),
      gradient_(2, 2 * fields.cols()) {
  for (const ElasticLaw& law : laws) in_plane_.push_back(law.stiffness({0, 1, 3}, {0, 1, 3}));
}

void CellSampler::sample(const Cell& cell, const CellShape& shape) {
  const int nodes = node_count(cell.kind);
  const CellPoint at = cell_point(mesh_.nodes, cell, shape);
  x = at.x;
  area = at.jacobian();
  const Eigen::Matrix2d xi_x = at.x_xi.inverse();
  for (int a = 0; a < nodes; ++a) slopes[a] = xi_x * shape.dN[a];
  find_gradients(cell);
  const ElasticLaw& law = laws_[cell.body];
  if (law.model.axisymmetric()) return add_rings(cell, shape, law);
  const Eigen::Matrix3d& C = in_plane_[cell.body];
  for (Eigen::Index k = 0; k < count_; ++k) stresses.segment<3>(3 * k) = (C * strain(k)).transpose();
}

void CellSampler::find_gradients(const Cell& cell) {
  const int nodes = node_count(cell.kind);
  if (count_ == 1) {
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    for (int a = 0; a < nodes; ++a) sum += slopes[a] * u_.row(cell.nodes[a]).head<2>();
    gradient_ = sum;
    return;
  }
  gradient_.setZero();
  double *along_x = &gradient_(0, 0), *along_y = &gradient_(1, 0);
  for (int a = 0; a < nodes; ++a) {
    const double dx = slopes[a].x(), dy = slopes[a].y(), *u = &u_(cell.nodes[a], 0);
    for (Eigen::Index k = 0; k < 2 * count_; ++k) {
      along_x[k] += dx * u[k];
      along_y[k] += dy * u[k];
    }
  }
}

// (eps_11, eps_22, gamma_12)
Eigen::Vector3d CellSampler::strain(Eigen::Index k) const {
  return {gradient_(0, k), gradient_(1, count_ + k), gradient_(1, k) + gradient_(0, count_ + k)};
}

void CellSampler::add_rings(const Cell& cell, const CellShape& shape, const ElasticLaw& law) {
  for (Eigen::Index k = 0; k < count_; ++k) {
    double radial = 0;
    for (int a = 0; a < node_count(cell.kind); ++a) radial += shape.N[a] * u_(cell.nodes[a], k);
    const Eigen::Vector3d e = strain(k);
    const Vec4 stress = law.stiffness * Vec4(e(0), e(1), radial / x.x(), e(2));
    stresses.segment<4>(4 * k) << stress(0), stress(1), stress(3), stress(2);
  }
}

}  // namespace mortise
