#include "fem/stress.hpp"

#include <Eigen/LU>

#include "fem/quadrature.hpp"

namespace mortise {
namespace {

// Samples of one kind and the matrix that extends them to the nodes.
struct Recovery {
  std::vector<CellShape> samples;
  CellShape centre;
  MatX to_nodes;  // node_count x sample count
};

// 1, x, y, xy: as many as there are samples.
MatX monomials(const Points& at, Eigen::Index count) {
  MatX m(at.rows(), count);
  for (Eigen::Index i = 0; i < at.rows(); ++i) {
    const Eigen::Vector4d all(1, at(i, 0), at(i, 1), at(i, 0) * at(i, 1));
    m.row(i) = all.head(count).transpose();
  }
  return m;
}

Recovery recovery_of(CellKind kind) {
  const CellRule rule = stress_points(kind);
  const Eigen::Index count = rule.points.size();
  Recovery r;
  Points at(count, 2);
  for (Eigen::Index q = 0; q < count; ++q) {
    at.row(q) = rule.points[q].transpose();
    r.samples.push_back(cell_shape(kind, rule.points[q]));
  }
  r.centre = cell_shape(kind, reference_centre(kind));
  r.to_nodes = monomials(reference_nodes(kind), count) * monomials(at, count).inverse();
  return r;
}

ForEachKind<Recovery> all_recoveries() {
  ForEachKind<Recovery> all;
  for (const CellKind kind : all_cell_kinds) all[int(kind)] = recovery_of(kind);
  return all;
}

}  // namespace

NodalStrains nodal_strains(const Cell& cell, const Model& model, const CellShape& shape, const CellPoint& at) {
  const Eigen::Matrix2d xi_x = at.x_xi.inverse();
  NodalStrains strains(4, 2 * node_count(cell.kind));
  for (int a = 0; a < node_count(cell.kind); ++a) {
    const Vec2 d = xi_x * shape.dN[a];
    const double hoop = model.axisymmetric() ? shape.N[a] / at.x.x() : 0;
    strains.middleCols<2>(2 * a) << d.x(), 0, 0, d.y(), hoop, 0, d.y(), d.x();
  }
  return strains;
}

Vec4 stress_at(const Mesh& mesh, const Cell& cell, const ElasticLaw& law, const VecX& u, const CellShape& shape) {
  const CellPoint at = cell_point(mesh.nodes, cell, shape);
  Eigen::Matrix2d u_xi = Eigen::Matrix2d::Zero();  // (i, j) = d u_j / d xi_i
  double u1 = 0;
  for (int a = 0; a < node_count(cell.kind); ++a) {
    const int node = cell.nodes[a];
    u_xi += shape.dN[a] * (u.segment<2>(2 * node) - u.segment<2>(2 * cell.nodes[0])).transpose();
    u1 += shape.N[a] * u(2 * node);
  }
  const Eigen::Matrix2d grad = at.x_xi.inverse() * u_xi;  // (i, j) = d u_j / d x_i
  const double hoop = !law.model.axisymmetric() ? 0 : at.x.x() > 0 ? u1 / at.x.x() : grad(0, 0);
  return law.stiffness * Vec4(grad(0, 0), grad(1, 1), hoop, grad(0, 1) + grad(1, 0)) + law.stress0(at.x);
}

StressField recover_stress(const Mesh& mesh, const BodyPoints& points, const std::vector<ElasticLaw>& laws,
                           const VecX& u) {
  const ForEachKind<Recovery> recoveries = all_recoveries();
  StressField field{Stresses::Zero(points.node.size(), 4), Stresses(mesh.cells.size(), 4)};
  std::vector<int> cells_at(points.node.size(), 0);
  const std::vector<Cell> on_points = cells_on_points(mesh, points);
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const Cell& cell = mesh.cells[e];
    const Recovery& r = recoveries[int(cell.kind)];
    const ElasticLaw& law = laws[cell.body];
    Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor, 4, 4> samples(r.samples.size(), 4);
    for (std::size_t q = 0; q < r.samples.size(); ++q)
      samples.row(q) = stress_at(mesh, cell, law, u, r.samples[q]).transpose();
    field.centres.row(e) = stress_at(mesh, cell, law, u, r.centre).transpose();
    for (int a = 0; a < node_count(cell.kind); ++a) {
      const int p = on_points[e].nodes[a];
      field.points.row(p) += r.to_nodes.row(a) * samples;
      ++cells_at[p];
    }
  }
  for (std::size_t p = 0; p < cells_at.size(); ++p) field.points.row(p) /= cells_at[p];
  return field;
}

}  // namespace mortise
