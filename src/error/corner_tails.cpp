#include "error/corner_tails.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/each_once.hpp"
#include "fem/elements.hpp"
#include "fem/locate.hpp"
#include "fem/quadrature.hpp"
#include "fem/stress.hpp"

namespace mortise {
namespace {

std::vector<int> cells_at(const SideTable& table, int node) {
  std::vector<int> cells;
  for (const SideAtNode& side : table.at(node)) cells.push_back(side.side.cell);
  keep_each_once(cells);
  return cells;
}

std::vector<int> cells_beside(const Mesh& mesh, const SideTable& table, const std::vector<int>& ring) {
  std::vector<int> near, beside;
  for (const int e : ring)
    for (int a = 0; a < corner_count(mesh.cells[e].kind); ++a)
      for (const int cell : cells_at(table, mesh.cells[e].nodes[a])) near.push_back(cell);
  keep_each_once(near);
  std::ranges::set_difference(near, ring, std::back_inserter(beside));
  return beside;
}

// Angle of a ring's cells at the node, by their corners.
double angle_at(const Mesh& mesh, int node, const std::vector<int>& ring) {
  double angle = 0;
  for (const int e : ring) {
    const Cell& cell = mesh.cells[e];
    const int corners = corner_count(cell.kind), a = int(std::ranges::find(cell.nodes, node) - cell.nodes.begin());
    const Vec2 x = mesh.nodes.row(node), next = mesh.nodes.row(cell.nodes[(a + 1) % corners]).transpose() - x,
               last = mesh.nodes.row(cell.nodes[(a + corners - 1) % corners]).transpose() - x;
    angle += std::acos(std::clamp(next.dot(last) / (next.norm() * last.norm()), -1.0, 1.0));
  }
  return angle;
}

}  // namespace

std::array<std::vector<int>, 2> rings_about(const Mesh& mesh, const SideTable& table, const std::vector<int>& nodes) {
  std::vector<int> ring;
  for (const int node : nodes) std::ranges::copy(cells_at(table, node), std::back_inserter(ring));
  keep_each_once(ring);
  std::vector<int> beside = cells_beside(mesh, table, ring);
  return {std::move(ring), std::move(beside)};
}

std::vector<CornerRings> corner_rings(const Mesh& mesh, const SideTable& table,
                                      const std::vector<BodyCorner>& corners) {
  std::vector<CornerRings> all;
  for (const BodyCorner& corner : corners) {
    CornerRings rings{.corner = corner, .cells = rings_about(mesh, table, {corner.node})};
    const double angle = angle_at(mesh, corner.node, rings.cells[0]);
    double area = 0;
    for (const int ring : {0, 1}) {
      for (const int e : rings.cells[ring]) area += cell_area(mesh, e);
      rings.radius[ring] = std::sqrt(2 * area / angle);
    }
    rings.degree = std::ranges::all_of(rings.cells[0], [&](int e) { return is_quadratic(mesh.cells[e].kind); });
    all.push_back(std::move(rings));
  }
  return all;
}

double missed_energy(double exponent, int degree) {
  double part = 1;
  for (int n = 0; n <= degree; ++n) {
    const double root = (1 - exponent + n) / (1 + exponent + n);
    part *= root * root;
  }
  return part;
}

void CornerProducts::add_cell(int number, const VecX& u, const DualSums& fields,
                              Eigen::Ref<Eigen::RowVectorXd> sums) const {
  const Cell& cell = mesh_.cells[number];
  const ElasticLaw& law = laws_[cell.body];
  const int nodes = node_count(cell.kind);
  const auto of_cell = [&](const auto& field) {
    MatX own(2 * nodes, field.cols());
    for (int a = 0; a < nodes; ++a) own.template middleRows<2>(2 * a) = field.template middleRows<2>(2 * cell.nodes[a]);
    return own;
  };
  const VecX own = of_cell(u);
  VecX forces = VecX::Zero(2 * nodes);  // of the stress, on the nodes
  const CellRule rule = product_rule(cell.kind, is_quadratic(cell.kind) ? 2 : 1);
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const CellShape shape = cell_shape(cell.kind, rule.points[q]);
    const CellPoint at = cell_point(mesh_.nodes, cell, shape);
    const NodalStrains B = nodal_strains(cell, law.model, shape, at);
    const Vec4 stress = law.stiffness * Vec4(B * own);
    forces += rule.weights[q] * at.jacobian() * law.model.depth(at.x.x()) * (B.transpose() * stress);
  }
  for (const auto& [z, of] : fields.terms()) sums += forces.transpose() * of_cell(z) * of;
}

void CornerProducts::add(const VecX& u, const DualSums& fields) {
  const Eigen::Index count = Eigen::Index(corners_.size()), before = products_[0].cols(), more = fields.count();
  for (const int ring : {0, 1}) {
    MatX& products = products_[ring];
    products.conservativeResize(count, before + more);
    for (Eigen::Index c = 0; c < count; ++c) {
      Eigen::RowVectorXd sums = Eigen::RowVectorXd::Zero(more);
      for (const int cell : corners_[c].cells[ring]) add_cell(cell, u, fields, sums);
      products.row(c).tail(more) = sums;
    }
  }
}

MatX CornerProducts::tails() const {
  MatX tails = MatX::Zero(products_[0].rows(), products_[0].cols());
  for (Eigen::Index c = 0; c < tails.rows(); ++c) {
    const CornerRings& rings = corners_[c];
    const double lambda = rings.corner.exponent, near = rings.radius[0] * rings.radius[0],
                 far = rings.radius[1] * rings.radius[1], power = std::pow(rings.radius[0], 2 * lambda);
    // P / r^2 = a r^(2 lambda - 2) + b at both radii.
    const double difference = power / near - std::pow(rings.radius[1], 2 * lambda) / far;
    const Eigen::RowVectorXd inner = products_[0].row(c), both = inner + products_[1].row(c);
    Eigen::RowVectorXd a = inner / power;  // of a body that has no cell beyond the first ring, all of it
    if (!rings.cells[1].empty()) a = (inner / near - both / far) / difference;
    tails.row(c) = missed_more * missed_energy(lambda, rings.degree) * power * a.cwiseAbs();
  }
  return tails;
}

}  // namespace mortise
