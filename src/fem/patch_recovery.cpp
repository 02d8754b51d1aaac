#include "fem/patch_recovery.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
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
};

// Where the samples are: those of cell e are rows first[e] .. first[e + 1] - 1.
struct SamplePlaces {
  std::vector<int> first{0};
  std::vector<Vec2> x;

  explicit SamplePlaces(const Mesh& mesh) {
    ForEachKind<std::vector<CellShape>> shapes;
    for (const CellKind kind : all_cell_kinds)
      for (const Vec2& xi : stress_points(kind).points) shapes[int(kind)].push_back(cell_shape(kind, xi));
    for (const Cell& cell : mesh.cells) {
      for (const CellShape& shape : shapes[int(cell.kind)]) {
        x.emplace_back(0, 0);
        for (int a = 0; a < node_count(cell.kind); ++a)
          x.back() += shape.N[a] * mesh.nodes.row(cell.nodes[a]).transpose();
      }
      first.push_back(int(x.size()));
    }
  }
};

StressPatch fit(const Vec2& centre, const std::vector<int>& cells, int terms, const SamplePlaces& places,
                const Stresses& samples) {
  StressPatch patch{.centre = centre, .size = 0, .terms = terms};
  Eigen::RowVector4d mean = Eigen::RowVector4d::Zero();
  int count = 0;
  for (const int e : cells)
    for (int q = places.first[e]; q < places.first[e + 1]; ++q) {
      patch.size = std::max(patch.size, (places.x[q] - centre).norm());
      mean += (samples.row(q) - mean) / ++count;
    }
  Eigen::Matrix<double, 6, 6> M = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 4> right = Eigen::Matrix<double, 6, 4>::Zero();
  for (const int e : cells)
    for (int q = places.first[e]; q < places.first[e + 1]; ++q) {
      const Monomials m = monomials((places.x[q] - centre) / patch.size);
      M += m * m.transpose();
      right += m * (samples.row(q) - mean);
    }
  // Samples on few lines leave the terms of the highest degree open, as y^2 in a beam one element thick: they stay
  // small.
  const int highest = terms == 6 ? 3 : 1;
  M.diagonal().segment(highest, terms - highest).array() += 1e-12 * count;
  patch.coefficients.topRows(terms) = M.topLeftCorner(terms, terms).llt().solve(right.topRows(terms));
  patch.coefficients.row(0) += mean;
  return patch;
}

double compliance_energy(const ElasticLaw& law, const Vec4& s) {
  const double poisson = law.young / (2 * law.stiffness(3, 2)) - 1, trace = s(0) + s(1) + s(2);
  return ((1 + poisson) * (s.head<3>().squaredNorm() + 2 * s(3) * s(3)) - poisson * trace * trace) / law.young;
}

}  // namespace

Vec4 StressPatch::at(const Vec2& x) const {
  return coefficients.topRows(terms).transpose() * monomials((x - centre) / size).head(terms);
}

std::vector<StressPatch> recover_patches(const Mesh& mesh, const BodyPoints& points, const Stresses& samples) {
  const std::vector<Cell> on_points = cells_on_points(mesh, points);
  const int count = int(points.node.size());
  const CellsAround around(on_points, count);
  const SamplePlaces places(mesh);
  const auto samples_in = [&](const std::vector<int>& cells) {
    int sum = 0;
    for (const int e : cells) sum += places.first[e + 1] - places.first[e];
    return sum;
  };
  std::vector<StressPatch> patches(count);
  for (int p = 0; p < count; ++p) {
    std::vector<int> cells(around.cells.begin() + around.first[p], around.cells.begin() + around.first[p + 1]);
    if (cells.empty()) continue;  // no vertex
    const bool quadratic = std::ranges::all_of(cells, [&](int e) { return is_quadratic(mesh.cells[e].kind); });
    const int wanted = quadratic ? 9 : 4;
    if (samples_in(cells) < wanted) {
      for (const int e : std::vector(cells))
        for (int a = 0; a < corner_count(on_points[e].kind); ++a) {
          const int q = on_points[e].nodes[a];
          cells.insert(cells.end(), around.cells.begin() + around.first[q], around.cells.begin() + around.first[q + 1]);
        }
      std::ranges::sort(cells);
      cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    }
    const int found = samples_in(cells), terms = quadratic && found >= 9 ? 6 : found >= 4 ? 3 : 1;
    patches[p] = fit(mesh.nodes.row(points.node[p]).transpose(), cells, terms, places, samples);
  }
  return patches;
}

EnergyErrors energy_errors(const Mesh& mesh, const BodyPoints& points, const std::vector<ElasticLaw>& laws,
                           const VecX& u, const std::vector<StressPatch>& patches) {
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
  EnergyErrors found{.errors = VecX::Zero(mesh.cells.size()), .areas = VecX::Zero(mesh.cells.size())};
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const Cell& cell = mesh.cells[e];
    const Rule& rule = rules[int(cell.kind)];
    for (std::size_t q = 0; q < rule.weights.size(); ++q) {
      const CellShape& shape = rule.shapes[q];
      Vec2 x = Vec2::Zero();
      Eigen::Matrix2d jacobian = Eigen::Matrix2d::Zero();
      for (int a = 0; a < node_count(cell.kind); ++a) {
        x += shape.N[a] * mesh.nodes.row(cell.nodes[a]).transpose();
        jacobian += shape.dN[a] * mesh.nodes.row(cell.nodes[a]);
      }
      Vec4 recovered = Vec4::Zero();
      for (int a = 0; a < corner_count(cell.kind); ++a)
        recovered += rule.linear[q].N[a] * patches[on_points[e].nodes[a]].at(x);
      const ElasticLaw& law = laws[cell.body];
      const double area = rule.weights[q] * jacobian.determinant();
      found.areas(e) += area;
      found.errors(e) += area * compliance_energy(law, recovered - stress_at(mesh, cell, law, u, shape));
      found.norm += area * compliance_energy(law, recovered);
    }
  }
  return found;
}

}  // namespace mortise
