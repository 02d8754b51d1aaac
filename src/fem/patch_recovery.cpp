#include "fem/patch_recovery.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>
#include <span>

#include "base/each_once.hpp"
#include "fem/cell_sampler.hpp"
#include "fem/quadrature.hpp"

namespace mortise {
namespace {

// For each body point the cells that have a corner there: cells[first[p]] .. cells[first[p + 1] - 1].
struct CellsAround {
  std::vector<Cell> on_points;
  std::vector<int> first, cells;

  CellsAround(const Mesh& mesh, const BodyPoints& points)
      : on_points(cells_on_points(mesh, points)), first(points.node.size() + 1, 0) {
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
  std::vector<int> beside(std::vector<int> some) const {
    for (const int e : std::vector(some))
      for (int a = 0; a < corner_count(on_points[e].kind); ++a) {
        const int q = on_points[e].nodes[a];
        some.insert(some.end(), cells.begin() + first[q], cells.begin() + first[q + 1]);
      }
    keep_each_once(some);
    return some;
  }
};

// Calls visit(q) for each sample of some cells.
template <typename Visit>
void for_each_sample(std::span<const int> cells, const StressSamples& samples, Visit visit) {
  for (const int e : cells)
    for (int q = samples.first[e]; q < samples.first[e + 1]; ++q) visit(q);
}

Monomials powers(const StressPatches& patches, int p, const Vec2& x) {
  Monomials m = patches.monomials_at(p, x);
  m.tail(6 - patches.terms[p]).setZero();
  return m;
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

}  // namespace

void StressPatches::add_at(int p, const Vec2& x, double factor, Eigen::RowVectorXd& sum) const {
  const Monomials m = monomials_at(p, x);
  for (int t = 0; t < terms[p]; ++t) sum += factor * m(t) * coefficients.row(row[p] + t);
}

StressSamples sample_stresses(const Mesh& mesh, const std::vector<ElasticLaw>& laws, const MatX& fields) {
  return sample_some(mesh, laws, fields, {});
}

PatchRecovery::PatchRecovery(const Mesh& mesh, const BodyPoints& points, const StressSamples& samples,
                             const std::vector<char>& wanted) {
  const CellsAround around(mesh, points);
  const int count = int(points.node.size());
  const auto samples_in = [&](const std::vector<int>& cells) {
    int sum = 0;
    for (const int e : cells) sum += samples.first[e + 1] - samples.first[e];
    return sum;
  };
  empty_ = {.centre = std::vector<Vec2>(count, Vec2::Zero()),
            .size = std::vector<double>(count, 0),
            .terms = std::vector<int>(count, 0),
            .row = std::vector<int>(count, -1),
            .coefficients = {}};
  for (int p = 0; p < count; ++p) {
    if (around.first[p] == around.first[p + 1] || !(wanted.empty() || wanted[p])) continue;
    std::vector<int> cells = around.at(p);
    const bool quadratic = std::ranges::all_of(cells, [&](int e) { return is_quadratic(mesh.cells[e].kind); });
    if (samples_in(cells) < (quadratic ? 9 : 4)) cells = around.beside(cells);
    const int found = samples_in(cells);
    empty_.row[p] = 6 * int(patches_.size());
    empty_.terms[p] = quadratic && found >= 9 ? 6 : found >= 4 ? 3 : 1;
    empty_.centre[p] = mesh.nodes.row(points.node[p]);
    const int first = int(cells_.size());
    cells_.insert(cells_.end(), cells.begin(), cells.end());
    patches_.push_back({p, first, int(cells_.size()), parts_.size()});
    const Eigen::Matrix<double, 6, 6> inverse = inverse_at(p, cells, samples);
    for_each_sample(cells, samples, [&](int q) { parts_.push_back(inverse * powers(empty_, p, samples.x[q])); });
  }
}

// Of the normal equations.
Eigen::Matrix<double, 6, 6> PatchRecovery::inverse_at(int p, std::span<const int> cells, const StressSamples& samples) {
  const int terms = empty_.terms[p];
  int count = 0;
  for_each_sample(cells, samples, [&](int q) {
    empty_.size[p] = std::max(empty_.size[p], (samples.x[q] - empty_.centre[p]).norm());
    ++count;
  });
  Eigen::Matrix<double, 6, 6> M = Eigen::Matrix<double, 6, 6>::Zero();
  for_each_sample(cells, samples, [&](int q) {
    const Monomials m = powers(empty_, p, samples.x[q]);
    M += m * m.transpose();
  });
  // Samples on few lines leave the terms of the highest degree open, as y^2 in a beam one element thick: they stay
  // small.
  const int highest = terms == 6 ? 3 : 1;
  M.diagonal().segment(highest, terms - highest).array() += 1e-12 * count;
  M.diagonal().tail(6 - terms).setOnes();
  return M.llt().solve(Eigen::Matrix<double, 6, 6>::Identity());
}

// `Row`: of stresses.
template <typename Row>
void PatchRecovery::fit_patch(const Patch& patch, const StressSamples& samples, FieldStresses& coefficients) const {
  using Rows = Eigen::Matrix<double, 6, Row::ColsAtCompileTime, Eigen::RowMajor>;
  const std::span<const int> cells(cells_.data() + patch.first, cells_.data() + patch.last);
  const Eigen::Index columns = samples.stresses.cols();
  const auto stresses = [&](int q) { return Eigen::Map<const Row>(&samples.stresses(q, 0), columns); };
  Row mean = Row::Zero(columns), rest(columns);
  int count = 0;
  for_each_sample(cells, samples, [&](int q) {
    mean += stresses(q);
    ++count;
  });
  mean /= count;
  Eigen::Map<Rows> of_patch(&coefficients(empty_.row[patch.point], 0), 6, columns);
  const Monomials* part = parts_.data() + patch.first_part;
  for_each_sample(cells, samples, [&](int q) {
    rest = stresses(q) - mean;
    of_patch.noalias() += *part++ * rest;
  });
  of_patch.row(0) += mean;
}

StressPatches PatchRecovery::fit(const StressSamples& samples) const {
  StressPatches patches = empty_;
  const Eigen::Index columns = samples.stresses.cols();
  patches.coefficients = FieldStresses::Zero(6 * Eigen::Index(patches_.size()), columns);
  for (const Patch& patch : patches_)
    if (columns == 3)
      fit_patch<Eigen::RowVector3d>(patch, samples, patches.coefficients);
    else if (columns > 0)
      fit_patch<Eigen::RowVectorXd>(patch, samples, patches.coefficients);
  return patches;
}

StressPatches recover_patches(const Mesh& mesh, const BodyPoints& points, const StressSamples& samples) {
  return PatchRecovery(mesh, points, samples).fit(samples);
}

LocalRecovery::LocalRecovery(std::vector<int> some, const Mesh& mesh, const BodyPoints& points)
    : some_(std::move(some)), wanted_(points.node.size(), 0), take_(mesh.cells.size(), 0) {
  const CellsAround around(mesh, points);
  for (const int p : some_) {
    wanted_[p] = 1;
    for (const int e : around.beside(around.at(p))) take_[e] = 1;
  }
}

StressPatches LocalRecovery::recover(const Mesh& mesh, const BodyPoints& points, const std::vector<ElasticLaw>& laws,
                                     const MatX& fields) {
  const StressSamples samples = sample_some(mesh, laws, fields, take_);
  if (!recovery_) recovery_.emplace(mesh, points, samples, wanted_);
  return recovery_->fit(samples);
}

Eigen::RowVectorXd recovered_stress(const Mesh& mesh, const BodyPoints& points, const StressPatches& patches,
                                    const CellPlace& place) {
  const Cell& cell = mesh.cells[place.cell];
  const CellShape shape = cell_shape(cell.kind, place.xi), linear = cell_shape(linear_kind(cell.kind), place.xi);
  const Vec2 x = cell_point(mesh.nodes, cell, shape).x;
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(patches.coefficients.cols());
  for (int a = 0; a < corner_count(cell.kind); ++a)
    patches.add_at(point_of(points, cell.body, cell.nodes[a]), x, linear.N[a], sum);
  return sum;
}

Vec4 whole_stress(const std::vector<ElasticLaw>& laws, int body, const Eigen::RowVectorXd& recovered, const Vec2& x) {
  return all_components(laws[body], recovered, 0, components(laws)) + laws[body].stress0(x);
}

}  // namespace mortise
