#include "error/statics.hpp"

#include <algorithm>

namespace mortise {
namespace {

constexpr double determinate = 1e-9;  // of a unit motion: what a rigid motion may miss of it by round-off

// Columns n: rigid motions of bodies that hang together, those of rings along the axis only.
MatX rigid_motions(const Mesh& mesh, const BodyPoints& points, bool rings) {
  const std::vector<int> bonded = bonded_to(mesh, points);
  const int motions = rings ? 1 : 3;
  std::vector<int> first(bonded.size(), -1);
  int count = 0;
  for (std::size_t b = 0; b < bonded.size(); ++b)
    if (bonded[b] == int(b)) {
      first[b] = count;
      count += motions;
    }
  MatX columns = MatX::Zero(2 * mesh.nodes.rows(), count);
  for (std::size_t b = 0; b < bonded.size(); ++b)
    for (int p = points.first[b]; p < points.first[b + 1]; ++p)
      for (int i = 2 * points.node[p]; i < 2 * points.node[p] + 2; ++i)
        for (int c = 0; c < motions; ++c)
          columns(i, first[bonded[b]] + c) = unit_motion(mesh, i, rings ? 1 : c, Vec2::Zero());
  return columns;
}

}  // namespace

double unit_motion(const Mesh& mesh, int i, int c, const Vec2& centre) {
  if (c < 2) return i % 2 == c ? 1 : 0;
  const Vec2 arm = mesh.nodes.row(i / 2).transpose() - centre;
  return i % 2 == 0 ? -arm.y() : arm.x();
}

Statics::Statics(const Mesh& mesh, const BodyPoints& points, const SaddlePointSystem& system,
                 const std::vector<int>& idle)
    : row_scale_(system.row_scale) {
  motions_ = rigid_motions(mesh, points, system.constraints.rings);
  std::vector<int> fixed;
  for (int i = 0; i < int(system.constraints.fixed.size()); ++i)
    if (system.constraints.fixed[i] && std::ranges::find(idle, i) == idle.end()) fixed.push_back(i);
  const MatX of_rows = row_scale_.cwiseInverse().asDiagonal() * (system.B * motions_).eval();
  const auto& multipoint = system.constraints.multipoint;
  const MatX q = multipoint ? MatX(multipoint->inverse * motions_) : motions_;
  const SparseMatrix& springs = system.constraints.springs;
  const MatX of_springs = springs.cols() > 0 ? MatX(springs * motions_) : MatX(0, motions_.cols());
  all_.resize(of_rows.rows() + Eigen::Index(fixed.size()) + of_springs.rows(), motions_.cols());
  all_ << of_rows, q(fixed, Eigen::all), of_springs;
  if (all_.size() > 0) factor_.emplace(all_);
}

std::optional<VecX> Statics::motion(const VecX& rows) const {
  if (!factor_) return std::nullopt;
  VecX wanted = VecX::Zero(all_.rows());
  wanted.head(rows.size()) = rows.cwiseQuotient(row_scale_);
  const VecX parts = factor_->solve(wanted);
  if (!(largest_entry(wanted - all_ * parts) <= determinate * largest_entry(wanted))) return std::nullopt;
  return motions_ * parts;
}

}  // namespace mortise
