#include "solve/row_responses.hpp"

#include <algorithm>

extern "C" void dgemm_(const char* transposed_A, const char* transposed_B, const int* m, const int* n, const int* k,
                       const double* alpha, const double* A, const int* lda, const double* B, const int* ldb,
                       const double* beta, double* C, const int* ldc);

namespace mortise {
namespace {

MatX substituted(const BorderedCholesky& factor, const MatX& lambda) {
  return factor.backward(MatX::Zero(factor.size(), lambda.cols()), lambda);
}

}  // namespace

// Whether all of these rows are known now.
bool RowResponses::know(const BorderedCholesky& factor, const std::vector<int>& rows, Eigen::Index rows_in_all) {
  place_.resize(rows_in_all, -1);
  std::vector<int> missing;
  std::ranges::copy_if(rows, std::back_inserter(missing), [&](int row) { return place_[row] < 0; });
  const Eigen::Index more = Eigen::Index(missing.size()), most = factor.entries() / std::max(factor.unknowns(), 1);
  if (used_ + more > most || more > substituted_) return false;
  if (more == 0) return true;
  substituted_ -= more;
  MatX units = MatX::Zero(rows_in_all, more);
  for (Eigen::Index k = 0; k < more; ++k) units(missing[k], k) = 1;
  if (used_ + more > columns_.cols())
    columns_.conservativeResize(factor.unknowns(), std::min(most, std::max(used_ + more, 2 * columns_.cols())));
  columns_.middleCols(used_, more) = substituted(factor, units);
  for (const int row : missing) place_[row] = int(used_++);
  return true;
}

MatX RowResponses::at(const BorderedCholesky& factor, const MatX& lambda) {
  std::vector<int> rows;
  for (Eigen::Index r = 0; r < lambda.rows(); ++r)
    if (lambda.row(r).any()) rows.push_back(int(r));
  if (!know(factor, rows, lambda.rows())) {
    substituted_ += lambda.cols();
    return substituted(factor, lambda);
  }
  const int n = factor.unknowns(), count = int(lambda.cols()), used = int(used_);
  MatX u = MatX::Zero(n, count), parts = MatX::Zero(used, count);
  for (const int row : rows) parts.row(place_[row]) = lambda.row(row);
  const double one = 1, zero = 0;
  if (n > 0 && count > 0 && used > 0)
    dgemm_("N", "N", &n, &count, &used, &one, columns_.data(), &n, parts.data(), &used, &zero, u.data(), &n);
  return u;
}

}  // namespace mortise
