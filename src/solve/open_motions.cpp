#include "solve/open_motions.hpp"

#include "base/dense.hpp"
#include "solve/nonnegative_fit.hpp"

namespace mortise {
namespace {

constexpr double unbalanced = 1e-8;  // work that nothing carries, of the largest terms

}  // namespace

VecX driven_motions(const ContactRows& rows) {
  const VecX stiffness = rows.stiffness(), size = stiffness.cwiseMax(1e-10 * stiffness.maxCoeff()).cwiseSqrt(),
             h = rows.unbalanced(VecX::Zero(rows.scale().size()));
  std::vector<char> free;
  for (const char may_open : rows.unilateral()) free.push_back(!may_open);
  const MatX work = -(rows.openings() * size.cwiseInverse().asDiagonal()).transpose();
  const VecX b = h.cwiseQuotient(size);
  const NonnegativeFit fit = fit_nonnegative(work, b, free);
  const double terms = largest_entry(b.cwiseAbs() + work.cwiseAbs() * fit.x.cwiseAbs());
  if (!(largest_entry(fit.residual) > unbalanced * terms)) return VecX::Zero(h.size());
  return fit.residual.cwiseQuotient(size);
}

// With at + free a = across + Q y, across at right angles to the free motions: min |y|, H_open Q (y - y_at) <= w_open.
// Its solution is what the nonnegative fit of (0, 1) by the columns (-H_open Q, g) leaves.
VecX least_motions(const ContactRows& rows, const VecX& at, const MatX& free, const VecX& w,
                   const std::vector<char>& closed) {
  const Eigen::Index count = free.cols();
  const MatX Q = orthonormal(free);
  const VecX y = Q.transpose() * at, across = at - Q * y;
  const MatX opened = -rows.openings() * Q;  // rows x count: of w by y
  std::vector<Eigen::Index> open;
  for (Eigen::Index a = 0; a < w.size(); ++a)
    if (!closed[a] && opened.row(a).norm() > 0) open.push_back(a);
  MatX columns(count + 1, Eigen::Index(open.size()));
  for (std::size_t k = 0; k < open.size(); ++k) {
    const auto row = opened.row(open[k]);
    columns.col(Eigen::Index(k)) << row.transpose(), row.dot(y) - w(open[k]);
  }
  // A row that y = 0 leaves open asks for nothing; gaps count in the unit of the largest that it would overlap.
  const double unit = open.empty() ? 0 : columns.bottomRows(1).maxCoeff();
  if (!(unit > 0)) return across;
  columns.bottomRows(1) /= unit;
  const VecX left = fit_nonnegative(columns, VecX::Unit(count + 1, count), std::vector<char>(open.size(), 0)).residual;
  if (!(left(count) > 0)) return at;
  return across - Q * left.head(count) / left(count) * unit;
}

}  // namespace mortise
