#include "fem/error_products.hpp"

#include "fem/cell_sampler.hpp"
#include "fem/quadrature.hpp"

namespace mortise {
namespace {

struct Rule {
  std::vector<double> weights;
  std::vector<CellShape> shapes, linear;  // linear: of the corners alone
};

ForEachKind<Rule> error_rules() {
  ForEachKind<Rule> rules;
  for (const CellKind kind : all_cell_kinds) {
    const CellRule rule = product_rule(kind, is_quadratic(kind) ? 3 : 2);
    rules[int(kind)].weights = rule.weights;
    for (const Vec2& xi : rule.points) {
      rules[int(kind)].shapes.push_back(cell_shape(kind, xi));
      rules[int(kind)].linear.push_back(cell_shape(linear_kind(kind), xi));
    }
  }
  return rules;
}

// int d_0 : C^-1 : d_k over a cell as a function of field k: of the coefficients of the patches at its corners, less
// that of its nodes' displacements.
struct CellFunctional {
  std::array<std::array<Vec4, 6>, 4> patches;  // of each corner and monomial, a factor a component
  std::array<Vec2, 9> nodes;

  void clear() {
    for (auto& corner : patches) corner.fill(Vec4::Zero());
    nodes.fill(Vec2::Zero());
  }

  // As a strain g makes stresses C g, whose work on a field is that of its nodal forces on the nodes' displacements.
  void add_nodal_forces(const Cell& cell, const ElasticLaw& law, const CellSampler& at, const CellShape& shape,
                        const Vec4& g) {
    const bool rings = law.model.axisymmetric();
    const Vec4 s = law.stiffness * Vec4(g(0), g(1), rings ? g(3) : 0, g(2));
    for (int a = 0; a < node_count(cell.kind); ++a) {
      const Vec2& slope = at.slopes[a];
      const double hoop = rings ? s(2) * shape.N[a] / at.x.x() : 0;
      nodes[a] += Vec2(s(0) * slope.x() + s(3) * slope.y() + hoop, s(3) * slope.x() + s(1) * slope.y());
    }
  }
};

// What the stresses of a field, as FieldStresses has them, are multiplied by: of `error` : (11, 22, 33, 12).
Vec4 in_components(const ElasticLaw& law, const Vec4& error) {
  if (law.model.axisymmetric()) return {error(0), error(1), error(3), error(2)};
  const Eigen::RowVector3d& s33 = law.out_of_plane;
  return {error(0) + error(2) * s33(0), error(1) + error(2) * s33(1), error(3) + error(2) * s33(2), 0};
}

// The products of one cell with other fields.
class OtherFields {
 public:
  OtherFields(const RecoveredFields& others, Eigen::Index components)
      : patches_(others.patches), u_(by_node(others.fields)), count_(others.fields.cols()), components_(components) {}

  template <typename Row>
  void add(const CellFunctional& of, const Cell& cell, const Cell& on_points, Row&& products) const {
    for (int a = 0; a < corner_count(cell.kind); ++a) {
      const int p = on_points.nodes[a];
      for (int t = 0; t < patches_.terms[p]; ++t) {
        const Vec4& weight = of.patches[a][t];
        const double* s = &patches_.coefficients(patches_.row[p] + t, 0);
        for (Eigen::Index k = 0; k < count_; ++k)
          for (Eigen::Index c = 0; c < components_; ++c) products(k) += weight(c) * s[components_ * k + c];
      }
    }
    for (int a = 0; a < node_count(cell.kind); ++a) {
      const double* u = &u_(cell.nodes[a], 0);
      for (Eigen::Index k = 0; k < count_; ++k) products(k) -= of.nodes[a].x() * u[k] + of.nodes[a].y() * u[count_ + k];
    }
  }

 private:
  const StressPatches& patches_;
  NodalFields u_;
  Eigen::Index count_, components_;
};

}  // namespace

ErrorProducts error_products(const Mesh& mesh, const BodyPoints& points, const std::vector<ElasticLaw>& laws,
                             const RecoveredFields& field, const RecoveredFields& others) {
  const StressPatches& patches = field.patches;
  const ForEachKind<Rule> rules = error_rules();
  const std::vector<Cell> on_points = cells_on_points(mesh, points);
  const Eigen::Index cells = Eigen::Index(mesh.cells.size()), of_field = components(laws);
  const Eigen::Index count = others.fields.cols();
  ErrorProducts found{.products = MatX::Zero(cells, 1 + count), .norms = VecX::Zero(cells), .areas = VecX::Zero(cells)};
  CellSampler at(mesh, laws, field.fields);
  const OtherFields with(others, of_field);
  CellFunctional functional;
  std::array<Monomials, 4> blended;  // times the linear shape function of the corner
  Eigen::RowVectorXd recovered(of_field), own_row(count);
  for (Eigen::Index e = 0; e < cells; ++e) {
    const Cell& cell = mesh.cells[e];
    const ElasticLaw& law = laws[cell.body];
    const Rule& rule = rules[int(cell.kind)];
    functional.clear();
    own_row.setZero();
    double energy = 0;
    for (std::size_t q = 0; q < rule.weights.size(); ++q) {
      at.sample(cell, rule.shapes[q]);
      recovered.setZero();
      for (int a = 0; a < corner_count(cell.kind); ++a) {
        const int p = on_points[e].nodes[a];
        blended[a] = rule.linear[q].N[a] * patches.monomials_at(p, at.x);
        for (int t = 0; t < patches.terms[p]; ++t) {
          const double* s = &patches.coefficients(patches.row[p] + t, 0);
          for (Eigen::Index c = 0; c < of_field; ++c) recovered(c) += blended[a](t) * s[c];
        }
      }
      const double area = rule.weights[q] * at.area, volume = area * law.model.depth(at.x.x());
      const Vec4 whole = all_components(law, recovered, 0, of_field) + law.stress0(at.x);
      found.areas(e) += area;
      found.norms(e) += volume * whole.dot(law.compliance * whole);
      recovered -= at.stresses;
      const Vec4 d = all_components(law, recovered, 0, of_field), error = volume * law.compliance * d;
      energy += error.dot(d);
      const Vec4 g = in_components(law, error);
      for (int a = 0; a < corner_count(cell.kind); ++a)
        for (int t = 0; t < patches.terms[on_points[e].nodes[a]]; ++t) functional.patches[a][t] += blended[a](t) * g;
      functional.add_nodal_forces(cell, law, at, rule.shapes[q], g);
    }
    if (count > 0) with.add(functional, cell, on_points[e], own_row);
    found.products.row(e) << energy, own_row;
  }
  return found;
}

}  // namespace mortise
