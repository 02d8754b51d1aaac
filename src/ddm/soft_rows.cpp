#include "ddm/soft_rows.hpp"

#include <limits>
#include <numeric>

#include "solve/refine.hpp"

namespace mortise {
namespace {

// Of what the rows do against a motion alone: the root of round-off, which the two errors that it trades, of the zero
// that it stands for and of pivots that it makes large, have in common. Refinement takes both away.
const double motion_softness = std::sqrt(std::numeric_limits<double>::epsilon());

SparseMatrix with_stored_diagonal(const SparseMatrix& A) {
  SparseMatrix zeros(A.rows(), A.cols());
  zeros.reserve(Eigen::VectorXi::Constant(A.cols(), 1));
  for (Eigen::Index k = 0; k < A.cols(); ++k) zeros.insert(k, k) = 0;
  return A + zeros;
}

// A, a lower triangle, without the entries between the first rows that are not both kept.
SparseMatrix uncoupled(const SparseMatrix& A, const std::vector<char>& kept) {
  const int rows = int(kept.size());
  SparseMatrix left(A.rows(), A.cols());
  std::vector<int> sizes(A.cols(), 0);
  const auto stays = [&](int i, int j) { return i == j || i >= rows || (kept[i] && kept[j]); };
  for (int j = 0; j < A.cols(); ++j)
    for (SparseMatrix::InnerIterator it(A, j); it; ++it) sizes[j] += stays(int(it.row()), j);
  left.reserve(sizes);
  for (int j = 0; j < A.cols(); ++j)
    for (SparseMatrix::InnerIterator it(A, j); it; ++it)
      if (stays(int(it.row()), j)) left.insert(it.row(), j) = it.value();
  left.makeCompressed();
  return left;
}

}  // namespace

SoftRows::SoftRows(const SparseMatrix& system, Eigen::Index rows)
    : matrix_(with_stored_diagonal(system)), own_(matrix_.diagonal()), row_sums_(VecX::Zero(rows)), rows_(rows) {
  unit_ = stacked(own_.head(rows), stiffness()).cwiseSqrt();
  unit_ = unit_.cwiseMax(std::numeric_limits<double>::min());
  for_each_entry(system, [&](int i, int j, double value) {
    if (i >= rows) return;
    row_sums_(i) += std::abs(value);
    if (i != j) row_sums_(j) += std::abs(value);
  });
}

VecX SoftRows::stiffness() const {
  VecX sum = VecX::Zero(own_.size() - rows_);
  for (int a = 0; a < rows_; ++a)
    for (SparseMatrix::InnerIterator it(matrix_, a); it; ++it)
      if (it.row() >= rows_) sum(it.row() - rows_) += it.value() * it.value() / matrix_.coeff(a, a);
  return sum;
}

bool SoftRows::factorise(const VecX& compliance) {
  matrix_.diagonal() = own_;
  matrix_.diagonal().head(rows_) += compliance;
  const VecX held = stiffness();
  scale_ = stacked(matrix_.diagonal().head(rows_),
                   held.cwiseMax(std::numeric_limits<double>::epsilon() * largest_entry(held)))
               .cwiseSqrt()
               .cwiseInverse();
  std::vector<char> coupled(rows_);
  for (Eigen::Index a = 0; a < rows_; ++a) coupled[a] = compliance(a) <= far_more * row_sums_(a);
  SparseMatrix scaled = scale_.asDiagonal() * uncoupled(matrix_, coupled) * scale_.asDiagonal();
  scaled.diagonal().tail(held.size()).setConstant(border_beta);
  std::vector<int> one_by_one(rows_);
  std::iota(one_by_one.begin(), one_by_one.end(), 0);
  factor_.emplace(SparseMatrix(scaled.transpose()), one_by_one);
  if (factor_->failed_at() >= 0) return false;
  MatX S = factor_->take_border_compliance();
  S.diagonal().array() += motion_softness;
  motions_.compute(S);
  return motions_.info() == Eigen::Success;
}

VecX SoftRows::solved(const VecX& rhs) const {
  const VecX scaled = scale_.cwiseProduct(rhs), y = factor_->forward(scaled.head(rows_)),
             mu = motions_.solve(factor_->at_border(y) - scaled.tail(rhs.size() - rows_));
  return scale_.cwiseProduct(stacked(factor_->backward(y, mu), mu));
}

ContactRows::Forces SoftRows::solve(const VecX& gap, const VecX& work) const {
  const VecX x = refined(
      stacked(gap, work), unit_, [&](const VecX& left) { return solved(left); },
      [&](const VecX& found) -> VecX { return matrix_.selfadjointView<Eigen::Lower>() * found; });
  return {.lambda = x.head(rows_), .mu = x.tail(work.size())};
}

}  // namespace mortise
