#include "fem/error_products.hpp"

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

// Coefficients of one component in a cell: six of each corner; triangles leave the last ones zero.
constexpr int of_corners = 24;

// (11, 22, 12) of a stress, and 33 of rings.
template <int components>
using Components = Eigen::Matrix<double, components, 1>;

// int d_0 : C^-1 : d_k over a cell as a function of field k: of the coefficients of the patches at its corners, less
// that of its nodes' displacements.
template <int components>
struct CellFunctional {
  Eigen::Matrix<double, of_corners, components> patches;
  std::array<Vec2, 9> nodes;

  void clear() {
    patches.setZero();
    nodes.fill(Vec2::Zero());
  }

  // As a strain g makes stresses C g, whose work on a field is that of its nodal forces on the nodes' displacements.
  void add_nodal_forces(const Cell& cell, const ElasticLaw& law, const CellSampler& at, const CellShape& shape,
                        const Components<components>& g) {
    constexpr bool rings = components == 4;
    const Vec4 s = law.stiffness * Vec4(g(0), g(1), rings ? g(components - 1) : 0, g(2));
    const Vec2 along_x(s(0), s(3)), along_y(s(3), s(1));
    for (int a = 0; a < node_count(cell.kind); ++a) {
      const Vec2& slope = at.slopes[a];
      nodes[a] += slope.x() * along_x + slope.y() * along_y;
      if (rings) nodes[a].x() += s(2) * shape.N[a] / at.x.x();
    }
  }
};

Vec4 whole(const ElasticLaw& law, const Components<3>& s) {
  return {s(0), s(1), law.out_of_plane.dot(s.transpose()), s(2)};
}
Vec4 whole(const ElasticLaw&, const Components<4>& s) { return {s(0), s(1), s(3), s(2)}; }

// What the components of a field are multiplied by: of `error` : (11, 22, 33, 12).
template <int components>
Components<components> in_components(const ElasticLaw& law, const Vec4& error) {
  if constexpr (components == 4)
    return {error(0), error(1), error(3), error(2)};
  else
    return Components<3>(error(0), error(1), error(3)) + error(2) * law.out_of_plane.transpose();
}

// Of field 0 in one cell: what it does to the others, and its own figures.
template <int components>
class OwnField {
 public:
  CellFunctional<components> functional;
  double energy = 0, norm = 0, area = 0;

  OwnField(const Mesh& mesh, const std::vector<ElasticLaw>& laws, const RecoveredFields& field)
      : laws_(laws), patches_(field.patches), at_(mesh, laws, field.fields), rules_(error_rules()) {}

  void integrate(const Cell& cell, const Cell& on_points) {
    const Rule& rule = rules_[int(cell.kind)];
    functional.clear();
    blended_.setZero();
    coefficients_.setZero();
    energy = norm = area = 0;
    for (int a = 0; a < corner_count(cell.kind); ++a) {
      const int p = on_points.nodes[a];
      corners_[a] = {patches_.centre[p], 1 / patches_.size[p]};
      const double* rows = &patches_.coefficients(patches_.row[p], 0);
      coefficients_.template middleRows<6>(6 * a) =
          Eigen::Map<const Eigen::Matrix<double, 6, components, Eigen::RowMajor>>(rows);
    }
    for (std::size_t q = 0; q < rule.weights.size(); ++q) add(cell, rule.shapes[q], rule.linear[q], rule.weights[q]);
  }

 private:
  void add(const Cell& cell, const CellShape& shape, const CellShape& linear, double weight) {
    const ElasticLaw& law = laws_[cell.body];
    at_.sample(cell, shape);
    for (int a = 0; a < corner_count(cell.kind); ++a) {  // monomials_at: as a vector it is read at once, and waits
      const Vec2 x = corners_[a].per_size * (at_.x - corners_[a].centre);
      double* m = &blended_(6 * a);
      m[0] = linear.N[a];
      m[1] = m[0] * x.x();
      m[2] = m[0] * x.y();
      m[3] = m[1] * x.x();
      m[4] = m[1] * x.y();
      m[5] = m[2] * x.y();
    }
    Components<components> d = coefficients_.transpose() * blended_;
    const double volume = weight * at_.area * law.model.depth(at_.x.x());
    const Vec4 stress = whole(law, d) + law.stress0(at_.x);
    area += weight * at_.area;
    norm += volume * stress.dot(law.compliance * stress);
    d -= at_.stresses.head<components>().transpose();
    const Vec4 difference = whole(law, d), error = volume * (law.compliance * difference);
    energy += error.dot(difference);
    const Components<components> g = in_components<components>(law, error);
    functional.patches.noalias() += blended_ * g.transpose();
    functional.add_nodal_forces(cell, law, at_, shape, g);
  }

  struct Corner {
    Vec2 centre;
    double per_size;
  };

  const std::vector<ElasticLaw>& laws_;
  const StressPatches& patches_;
  CellSampler at_;
  const ForEachKind<Rule> rules_;
  std::array<Corner, 4> corners_;
  Eigen::Matrix<double, of_corners, components> coefficients_;
  Eigen::Matrix<double, of_corners, 1> blended_;  // monomials times the linear shape function of their corner
};

// Adds the products of one cell with other fields.
template <int components>
void add_products(const CellFunctional<components>& of, const OtherFields& others, const Cell& cell,
                  const Cell& on_points, Eigen::Ref<Eigen::RowVectorXd> products) {
  using Row = Eigen::Map<const Eigen::RowVectorXd>;
  using Rows = Eigen::Map<const Eigen::Matrix<double, components, Eigen::Dynamic, Eigen::RowMajor>>;
  const Eigen::Index count = products.size();
  for (int a = 0; a < corner_count(cell.kind); ++a)
    for (int t = 0; t < 6; ++t) {
      const double* s = &others.coefficients(others.row[on_points.nodes[a]] + t, 0);
      products += of.patches.row(6 * a + t).lazyProduct(Rows(s, components, count));
    }
  for (int a = 0; a < node_count(cell.kind); ++a) {
    const double* u = &others.u(cell.nodes[a], 0);
    products.noalias() -= of.nodes[a].x() * Row(u, count) + of.nodes[a].y() * Row(u + count, count);
  }
}

template <int components>
ErrorProducts products_of(const Mesh& mesh, const BodyPoints& points, const std::vector<ElasticLaw>& laws,
                          const RecoveredFields& field, const std::vector<const OtherFields*>& others) {
  const std::vector<Cell> on_points = cells_on_points(mesh, points);
  const Eigen::Index cells = Eigen::Index(mesh.cells.size());
  Eigen::Index count = 0;
  for (const OtherFields* some : others) count += some->count();
  ErrorProducts found{.products = MatX(cells, 1 + count), .norms = VecX(cells), .areas = VecX(cells)};
  OwnField<components> own(mesh, laws, field);
  Eigen::RowVectorXd products(count);
  for (Eigen::Index e = 0; e < cells; ++e) {
    own.integrate(mesh.cells[e], on_points[e]);
    products.setZero();
    Eigen::Index first = 0;
    for (const OtherFields* some : others) {
      if (some->count() == 0) continue;
      add_products(own.functional, *some, mesh.cells[e], on_points[e], products.segment(first, some->count()));
      first += some->count();
    }
    found.products.row(e) << own.energy, products;
    found.norms(e) = own.norm;
    found.areas(e) = own.area;
  }
  return found;
}

}  // namespace

OtherFields::OtherFields(const RecoveredFields& fields)
    : row(fields.patches.row), coefficients(fields.patches.coefficients), u(by_node(fields.fields)) {
  if (count() == 0) return;
  const Eigen::Index components = coefficients.cols() / count();
  for (Eigen::Index i = 0; i < coefficients.rows(); ++i)
    for (Eigen::Index k = 0; k < count(); ++k)
      for (Eigen::Index c = 0; c < components; ++c)
        coefficients(i, c * count() + k) = fields.patches.coefficients(i, components * k + c);
}

ErrorProducts error_products(const Mesh& mesh, const BodyPoints& points, const std::vector<ElasticLaw>& laws,
                             const RecoveredFields& field, const std::vector<const OtherFields*>& others) {
  return components(laws) == 4 ? products_of<4>(mesh, points, laws, field, others)
                               : products_of<3>(mesh, points, laws, field, others);
}

}  // namespace mortise
