#include "fem/patch_recovery.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <numeric>

#include "fem/quadrature.hpp"

namespace mortise {
namespace {

using Monomials = Eigen::Matrix<double, 6, 1>;

Monomials monomials(const Vec2& x) { return {1, x.x(), x.y(), x.x() * x.x(), x.x() * x.y(), x.y() * x.y()}; }

// The cell of corners alone, whose shape functions are linear along the sides.
constexpr CellKind linear_kind(CellKind kind) { return corner_count(kind) == 3 ? CellKind::tri3 : CellKind::quad4; }

// For each body point the cells that have a corner there: cells[first[p]] .. cells[first[p + 1] - 1].
struct CellsAround {
  std::vector<int> first, cells;

  CellsAround(const std::vector<Cell>& on_points, int count) : first(count + 1, 0) {
    for (const Cell& cell : on_points)
      for (int a = 0; a < corner_count(cell.kind); ++a) ++first[cell.nodes[a] + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    cells.resize(first.back());
    std::vector<int> next(first.begin(), first.end() - 1);
    for (int e = 0; e < int(on_points.size()); ++e)
      for (int a = 0; a < corner_count(on_points[e].kind); ++a) cells[next[on_points[e].nodes[a]]++] = e;
  }

  std::vector<int> at(int p) const { return {cells.begin() + first[p], cells.begin() + first[p + 1]}; }

  // Some cells and those around their corners, each once.
  std::vector<int> beside(std::vector<int> some, const std::vector<Cell>& on_points) const {
    for (const int e : std::vector(some))
      for (int a = 0; a < corner_count(on_points[e].kind); ++a) {
        const int q = on_points[e].nodes[a];
        some.insert(some.end(), cells.begin() + first[q], cells.begin() + first[q + 1]);
      }
    std::ranges::sort(some);
    some.erase(std::unique(some.begin(), some.end()), some.end());
    return some;
  }
};

// A row a node, the displacements along x and y of all fields in it: 2 F columns, x of each first.
using NodalFields = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

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

// Stresses of a field: (11, 22, 12), and 33 of rings.
Eigen::Index components(const std::vector<ElasticLaw>& laws) { return laws.front().model.axisymmetric() ? 4 : 3; }

// A cell's geometry at a reference point, and the stresses of all fields there.
class CellSampler {
 public:
  Vec2 x;
  double area = 0;              // Jacobian determinant
  Eigen::RowVectorXd stresses;  // initial strains left out

  CellSampler(const Mesh& mesh, const std::vector<ElasticLaw>& laws, const MatX& fields)
      : stresses(components(laws) * fields.cols()),
        mesh_(mesh),
        laws_(laws),
        u_(by_node(fields)),
        gradient_(4, fields.cols()),
        radial_(fields.cols()),
        count_(fields.cols()) {}

  void sample(const Cell& cell, const CellShape& shape) {
    const int nodes = node_count(cell.kind);
    x.setZero();
    Eigen::Matrix2d x_xi = Eigen::Matrix2d::Zero();  // (i, j) = d x_j / d xi_i
    for (int a = 0; a < nodes; ++a) {
      x += shape.N[a] * mesh_.nodes.row(cell.nodes[a]).transpose();
      x_xi += shape.dN[a] * mesh_.nodes.row(cell.nodes[a]);
    }
    area = x_xi.determinant();
    const Eigen::Matrix2d xi_x = x_xi.inverse();
    gradient_.setZero();
    for (int a = 0; a < nodes; ++a) {
      const Vec2 d = xi_x * shape.dN[a];
      const double* u = &u_(cell.nodes[a], 0);
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {  // d u_i / d x_j
          double* row = &gradient_(2 * i + j, 0);
          const double* component = u + i * count_;
          for (Eigen::Index k = 0; k < count_; ++k) row[k] += d(j) * component[k];
        }
    }
    const ElasticLaw& law = laws_[cell.body];
    if (law.model.axisymmetric()) {
      add_rings(cell, shape, law);
    } else {
      const Eigen::Matrix3d C = law.stiffness({0, 1, 3}, {0, 1, 3});
      for (Eigen::Index k = 0; k < count_; ++k) stresses.segment<3>(3 * k) = (C * strain(k)).transpose();
    }
  }

 private:
  // (eps_11, eps_22, gamma_12)
  Eigen::Vector3d strain(Eigen::Index k) const {
    return {gradient_(0, k), gradient_(3, k), gradient_(1, k) + gradient_(2, k)};
  }

  void add_rings(const Cell& cell, const CellShape& shape, const ElasticLaw& law) {
    radial_.setZero();
    for (int a = 0; a < node_count(cell.kind); ++a) radial_ += shape.N[a] * u_.row(cell.nodes[a]).head(count_);
    for (Eigen::Index k = 0; k < count_; ++k) {
      const Eigen::Vector3d e = strain(k);
      const Vec4 stress = law.stiffness * Vec4(e(0), e(1), radial_(k) / x.x(), e(2));
      stresses.segment<4>(4 * k) << stress(0), stress(1), stress(3), stress(2);
    }
  }

  const Mesh& mesh_;
  const std::vector<ElasticLaw>& laws_;
  NodalFields u_;
  FieldStresses gradient_;  // 11, 12, 21, 22; F columns
  Eigen::RowVectorXd radial_;
  Eigen::Index count_;
};

// Fits patch p, whose terms are set, to the samples of the cells.
void fit(const std::vector<int>& cells, const StressSamples& samples, int p, StressPatches& patches) {
  const Eigen::Index columns = samples.stresses.cols();
  const int terms = patches.terms[p];
  double& size = patches.size[p];
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(columns);
  int count = 0;
  for (const int e : cells)
    for (int q = samples.first[e]; q < samples.first[e + 1]; ++q, ++count) {
      size = std::max(size, (samples.x[q] - patches.centre[p]).norm());
      mean += samples.stresses.row(q);
    }
  mean /= count;
  Eigen::Matrix<double, 6, 6> M = Eigen::Matrix<double, 6, 6>::Zero();
  auto right = patches.coefficients.middleRows<6>(patches.row[p]);
  for (const int e : cells)
    for (int q = samples.first[e]; q < samples.first[e + 1]; ++q) {
      const Monomials m = monomials((samples.x[q] - patches.centre[p]) / size);
      M += m * m.transpose();
      for (int t = 0; t < terms; ++t) right.row(t) += m(t) * (samples.stresses.row(q) - mean);
    }
  // Samples on few lines leave the terms of the highest degree open, as y^2 in a beam one element thick: they stay
  // small.
  const int highest = terms == 6 ? 3 : 1;
  M.diagonal().segment(highest, terms - highest).array() += 1e-12 * count;
  const MatX solution = M.topLeftCorner(terms, terms).llt().solve(right.topRows(terms));
  right.topRows(terms) = solution;
  right.row(0) += mean;
}

// `take`: flags of cells; the others have no samples. Empty: all have.
StressSamples sample_some(const Mesh& mesh, const std::vector<ElasticLaw>& laws, const MatX& fields,
                          const std::vector<char>& take) {
  ForEachKind<std::vector<CellShape>> shapes;
  for (const CellKind kind : all_cell_kinds)
    for (const Vec2& xi : stress_points(kind).points) shapes[int(kind)].push_back(cell_shape(kind, xi));
  const auto taken = [&](std::size_t e) { return take.empty() || take[e]; };
  StressSamples samples;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e)
    samples.first.push_back(samples.first.back() + (taken(e) ? int(shapes[int(mesh.cells[e].kind)].size()) : 0));
  samples.stresses.resize(samples.first.back(), components(laws) * fields.cols());
  CellSampler at(mesh, laws, fields);
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    if (!taken(e)) continue;
    for (const CellShape& shape : shapes[int(mesh.cells[e].kind)]) {
      at.sample(mesh.cells[e], shape);
      samples.stresses.row(Eigen::Index(samples.x.size())) = at.stresses;
      samples.x.push_back(at.x);
    }
  }
  return samples;
}

// Patches of all vertices among the body points that `wanted` flags; of all where it is empty.
StressPatches recover_some(const Mesh& mesh, const std::vector<Cell>& on_points, const CellsAround& around,
                           const BodyPoints& points, const StressSamples& samples, const std::vector<char>& wanted) {
  const int count = int(points.node.size());
  const auto samples_in = [&](const std::vector<int>& cells) {
    int sum = 0;
    for (const int e : cells) sum += samples.first[e + 1] - samples.first[e];
    return sum;
  };
  StressPatches patches{.centre = std::vector<Vec2>(count, Vec2::Zero()),
                        .size = std::vector<double>(count, 0),
                        .terms = std::vector<int>(count, 0),
                        .row = std::vector<int>(count, -1),
                        .coefficients = {}};
  int rows = 0;
  for (int p = 0; p < count; ++p) {
    if (around.first[p] == around.first[p + 1] || !(wanted.empty() || wanted[p])) continue;
    patches.row[p] = rows;
    rows += 6;
  }
  patches.coefficients = MatX::Zero(rows, samples.stresses.cols());
  for (int p = 0; p < count; ++p) {
    if (patches.row[p] < 0) continue;
    std::vector<int> cells = around.at(p);
    const bool quadratic = std::ranges::all_of(cells, [&](int e) { return is_quadratic(mesh.cells[e].kind); });
    if (samples_in(cells) < (quadratic ? 9 : 4)) cells = around.beside(cells, on_points);
    const int found = samples_in(cells);
    patches.terms[p] = quadratic && found >= 9 ? 6 : found >= 4 ? 3 : 1;
    patches.centre[p] = mesh.nodes.row(points.node[p]);
    fit(cells, samples, p, patches);
  }
  return patches;
}

// (11, 22, 33, 12) of the stresses of one field.
Vec4 all_components(const ElasticLaw& law, const Eigen::RowVectorXd& s, Eigen::Index first, Eigen::Index count) {
  const double s33 = count == 4 ? s(first + 3) : law.out_of_plane.dot(s.segment<3>(first));
  return {s(first), s(first + 1), s33, s(first + 2)};
}

}  // namespace

void StressPatches::add_at(int p, const Vec2& x, double factor, Eigen::RowVectorXd& sum) const {
  const Monomials m = monomials((x - centre[p]) / size[p]);
  for (int t = 0; t < terms[p]; ++t) sum += factor * m(t) * coefficients.row(row[p] + t);
}

StressSamples sample_stresses(const Mesh& mesh, const std::vector<ElasticLaw>& laws, const MatX& fields) {
  return sample_some(mesh, laws, fields, {});
}

StressPatches recover_patches(const Mesh& mesh, const BodyPoints& points, const StressSamples& samples) {
  const std::vector<Cell> on_points = cells_on_points(mesh, points);
  return recover_some(mesh, on_points, CellsAround(on_points, int(points.node.size())), points, samples, {});
}

StressPatches recover_patches_at(const std::vector<int>& some, const Mesh& mesh, const BodyPoints& points,
                                 const std::vector<ElasticLaw>& laws, const MatX& fields) {
  const std::vector<Cell> on_points = cells_on_points(mesh, points);
  const CellsAround around(on_points, int(points.node.size()));
  std::vector<char> wanted(points.node.size(), 0), take(mesh.cells.size(), 0);
  for (const int p : some) {
    wanted[p] = 1;
    for (const int e : around.beside(around.at(p), on_points)) take[e] = 1;
  }
  return recover_some(mesh, on_points, around, points, sample_some(mesh, laws, fields, take), wanted);
}

Eigen::RowVectorXd recovered_stress(const Mesh& mesh, const BodyPoints& points, const StressPatches& patches,
                                    const CellPlace& place) {
  const Cell& cell = mesh.cells[place.cell];
  const CellShape shape = cell_shape(cell.kind, place.xi), linear = cell_shape(linear_kind(cell.kind), place.xi);
  Vec2 x = Vec2::Zero();
  for (int a = 0; a < node_count(cell.kind); ++a) x += shape.N[a] * mesh.nodes.row(cell.nodes[a]).transpose();
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(patches.coefficients.cols());
  for (int a = 0; a < corner_count(cell.kind); ++a)
    patches.add_at(point_of(points, cell.body, cell.nodes[a]), x, linear.N[a], sum);
  return sum;
}

Vec4 whole_stress(const std::vector<ElasticLaw>& laws, int body, const Eigen::RowVectorXd& recovered, const Vec2& x) {
  return all_components(laws[body], recovered, 0, components(laws)) + laws[body].stress0(x);
}

ErrorProducts error_products(const Mesh& mesh, const BodyPoints& points, const std::vector<ElasticLaw>& laws,
                             const MatX& fields, const StressPatches& patches) {
  struct Rule {
    std::vector<double> weights;
    std::vector<CellShape> shapes, linear;
  };
  ForEachKind<Rule> rules;
  for (const CellKind kind : all_cell_kinds) {
    const CellRule rule = product_rule(kind, is_quadratic(kind) ? 3 : 2);
    rules[int(kind)].weights = rule.weights;
    for (const Vec2& xi : rule.points) {
      rules[int(kind)].shapes.push_back(cell_shape(kind, xi));
      rules[int(kind)].linear.push_back(cell_shape(linear_kind(kind), xi));
    }
  }
  const std::vector<Cell> on_points = cells_on_points(mesh, points);
  const Eigen::Index cells = Eigen::Index(mesh.cells.size()), count = fields.cols(), of_field = components(laws);
  ErrorProducts found{.products = MatX::Zero(cells, count), .norms = VecX::Zero(cells), .areas = VecX::Zero(cells)};
  CellSampler at(mesh, laws, fields);
  Eigen::RowVectorXd recovered(of_field * count);
  for (Eigen::Index e = 0; e < cells; ++e) {
    const Cell& cell = mesh.cells[e];
    const ElasticLaw& law = laws[cell.body];
    const Rule& rule = rules[int(cell.kind)];
    for (std::size_t q = 0; q < rule.weights.size(); ++q) {
      at.sample(cell, rule.shapes[q]);
      recovered.setZero();
      for (int a = 0; a < corner_count(cell.kind); ++a)
        patches.add_at(on_points[e].nodes[a], at.x, rule.linear[q].N[a], recovered);
      const double area = rule.weights[q] * at.area, volume = area * law.model.depth(at.x.x());
      const Vec4 whole = all_components(law, recovered, 0, of_field) + law.stress0(at.x);
      found.areas(e) += area;
      found.norms(e) += volume * whole.dot(law.compliance * whole);
      recovered -= at.stresses;
      const Vec4 error = volume * law.compliance * all_components(law, recovered, 0, of_field);
      for (Eigen::Index k = 0; k < count; ++k)
        found.products(e, k) += error.dot(all_components(law, recovered, of_field * k, of_field));
    }
  }
  return found;
}

}  // namespace mortise
