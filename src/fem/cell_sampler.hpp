// Stresses of many displacement fields at once, point by point.
#pragma once

#include "fem/stress.hpp"

namespace mortise {

/// A row a node, the displacements along x and y of all fields in it: 2 F columns, x of each first.
using NodalFields = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// `fields`: n x F, displacements.
NodalFields by_node(const MatX& fields);

/// Stresses of a field: (11, 22, 12), and 33 of rings.
Eigen::Index components(const std::vector<ElasticLaw>& laws);

/// (11, 22, 33, 12) of `count` such components, those from `first` on.
Vec4 all_components(const ElasticLaw& law, const Eigen::RowVectorXd& s, Eigen::Index first, Eigen::Index count);

/// The cell of corners alone, whose shape functions are linear along the sides.
constexpr CellKind linear_kind(CellKind kind) { return corner_count(kind) == 3 ? CellKind::tri3 : CellKind::quad4; }

/// A cell's geometry at a reference point, and the stresses of all fields there.
class CellSampler {
 public:
  Vec2 x;
  double area = 0;              ///< Jacobian determinant
  std::array<Vec2, 9> slopes;   ///< of the nodes' shape functions, d / dx
  Eigen::RowVectorXd stresses;  ///< (11, 22, 12) of each field, of rings (11, 22, 12, 33)

  /// `laws`: of one model.
  CellSampler(const Mesh& mesh, const std::vector<ElasticLaw>& laws, const MatX& fields);

  void sample(const Cell& cell, const CellShape& shape);

 private:
  void find_gradients(const Cell& cell);
  Eigen::Vector3d strain(Eigen::Index k) const;
  void add_rings(const Cell& cell, const CellShape& shape, const ElasticLaw& law);

  const Mesh& mesh_;
  const std::vector<ElasticLaw>& laws_;
  std::vector<Eigen::Matrix3d> in_plane_;  // of their stiffness, (11, 22, 12)
  NodalFields u_;
  Eigen::Index count_;
  NodalFields gradient_;  // 2 x 2 F: (j, i F + k) = d u_i / d x_j of field k
};

}  // namespace mortise
