#include "fem/foundation.hpp"

#include <algorithm>
#include <cmath>

namespace mortise {

void add_foundation(const Mesh& mesh, const Model& model, const CutSides& on, const Foundation& foundation,
                    Triplets& entries) {
  on.for_each_point(mesh, model, [&](const Edge& edge, const EdgePoint& p, const EdgeShape& s, double dA) {
    const Eigen::Matrix2d k = dA * foundation(p.position, p.normal());
    for (int i = 0; i < 2 * edge.node_count; ++i)
      for (int j = 0; j < 2 * edge.node_count; ++j) {
        const int row = 2 * edge.nodes[i / 2] + i % 2, column = 2 * edge.nodes[j / 2] + j % 2;
        if (row >= column) entries.emplace_back(row, column, s.N[i / 2] * k(i % 2, j % 2) * s.N[j / 2]);
      }
  });
}

SparseMatrix spring_rows(const SparseMatrix& stiffness) {
  SparseMatrix rows = stiffness.selfadjointView<Eigen::Lower>();
  VecX largest = VecX::Zero(rows.rows());
  const auto for_each_entry = [&](const auto& visit) {
    for (Eigen::Index k = 0; k < rows.nonZeros(); ++k) visit(rows.valuePtr()[k], largest(rows.innerIndexPtr()[k]));
  };
  for_each_entry([](double value, double& most) { most = std::max(most, std::abs(value)); });
  for_each_entry([](double& value, double most) { value = most > 0 ? value / most : 0; });
  return rows;
}

VecX spring_parts(const SparseMatrix& stiffness, const SparseMatrix& of_elements) {
  const VecX springs = stiffness.diagonal(), own = of_elements.diagonal();
  VecX parts = VecX::Zero(springs.size());
  for (Eigen::Index i = 0; i < parts.size(); ++i)
    if (springs(i) > 0) parts(i) = own(i) > 0 ? springs(i) / own(i) : 1;
  return parts;
}

}  // namespace mortise
