#include "base/null_space.hpp"

#include <Eigen/SparseCholesky>
#include <random>

#include "base/dense.hpp"

namespace mortise {
namespace {

constexpr Eigen::Index small = 100;  // rows
constexpr int inverse_steps = 4;

using Factor = Eigen::SimplicialLDLT<SparseMatrix>;

// Columns of V that span the eigenvectors with eigenvalues of at most `limit` in the space of V.
MatX small_ones(const SparseMatrix& A, const MatX& V, double limit) {
  const SymmetricEigen eigen = symmetric_eigen(V.transpose() * (A * V));
  Eigen::Index count = 0;
  while (count < eigen.values.size() && eigen.values(count) <= limit) ++count;
  return V * eigen.vectors.leftCols(count);
}

}  // namespace

MatX null_space(const SparseMatrix& A, double limit) {
  const Eigen::Index n = A.rows();
  if (n <= small) return small_ones(A, MatX::Identity(n, n), limit);
  Factor factor;
  factor.analyzePattern(A);
  factor.setShift(-limit);
  factor.factorize(A);
  const VecX pivots = factor.vectorD();
  const Eigen::Index count = (pivots.array() < 0).count();
  if (count == 0) return MatX(n, 0);
  factor.setShift(limit);
  factor.factorize(A);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> value(-1, 1);
  MatX V = MatX::NullaryExpr(n, std::min(n, count + 2), [&] { return value(random); });
  for (int step = 0; step < inverse_steps; ++step) V = orthonormal(factor.solve(V));
  return small_ones(A, V, limit);
}

}  // namespace mortise
