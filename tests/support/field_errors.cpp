#include "support/field_errors.hpp"

#include <Eigen/LU>
#include <cmath>

#include "fem/quadrature.hpp"
#include "fem/stress.hpp"

namespace mortise::test {
namespace {

// Strains (11, 22, twice 12) from stresses (11, 22, 12).
Eigen::Matrix3d compliance(const ElasticLaw& law) { return law.stiffness({0, 1, 3}, {0, 1, 3}).inverse(); }

}  // namespace

FieldErrors field_errors(const Mesh& mesh, const std::vector<ElasticLaw>& laws, const VecX& u, const Field& exact) {
  std::vector<Eigen::Matrix3d> compliances;
  for (const ElasticLaw& law : laws) compliances.push_back(compliance(law));
  double l2 = 0, energy = 0;
  for (const Cell& cell : mesh.cells) {
    const auto body = std::size_t(cell.body);
    const CellRule rule = product_rule(cell.kind, 4);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const CellShape s = cell_shape(cell.kind, rule.points[q]);
      const CellPoint at = cell_point(mesh.nodes, cell, s);
      const Vec2 x = at.x;
      Vec2 value = Vec2::Zero();
      for (int a = 0; a < node_count(cell.kind); ++a) value += s.N[a] * u.segment<2>(2 * cell.nodes[a]);
      const double dV = rule.weights[q] * at.jacobian();
      const Vec4 e = stress_at(mesh, cell, laws[body], u, s) - exact.stress(x, cell.body);
      const Eigen::Vector3d difference(e(0), e(1), e(3));
      l2 += dV * (value - exact.displacement(x, cell.body)).squaredNorm();
      energy += dV * difference.dot(compliances[body] * difference);
    }
  }
  return {std::sqrt(l2), std::sqrt(energy)};
}

}  // namespace mortise::test
