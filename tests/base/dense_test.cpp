// Dense decompositions of random matrices, by what defines them.
#include "base/dense.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace mortise {
namespace {

MatX random_matrix(Eigen::Index rows, Eigen::Index columns, std::mt19937& draw) {
  std::uniform_real_distribution<double> value(-1, 1);
  return MatX::NullaryExpr(rows, columns, [&] { return value(draw); });
}

TEST(Dense, KernelsAreWhatIsMappedToZero) {
  std::mt19937 draw(5);
  for (int k = 0; k < 50; ++k) {
    const Eigen::Index n = 1 + k % 7, rank = k % (n + 1), m = n + k % 3;
    const MatX A = random_matrix(m, rank, draw) * random_matrix(rank, n, draw), kernel = kernel_of(A);
    ASSERT_EQ(kernel.cols(), n - rank) << m << " x " << n;
    if (kernel.cols() == 0) continue;
    EXPECT_LE((A * kernel).norm(), 1e-13 * (1 + kernel.norm()));
    EXPECT_EQ(kernel_of(kernel).cols(), 0) << "its columns are independent";
  }
  EXPECT_EQ(kernel_of(VecX{{1, 1e-9}}.asDiagonal().toDenseMatrix()).cols(), 0);
  EXPECT_EQ(kernel_of(VecX{{1, 1e-9}}.asDiagonal().toDenseMatrix(), 1e-8).cols(), 1);
}

TEST(Dense, LeastSquaresLeaveWhatNoColumnHas) {
  std::mt19937 draw(7);
  for (int k = 0; k < 30; ++k) {
    const MatX A = random_matrix(8 + k, 1 + k % 8, draw), b = random_matrix(8 + k, 1, draw);
    const VecX left = b - A * LeastSquares(A).solve(b);
    EXPECT_LE((A.transpose() * left).norm(), 1e-12);
    const MatX Q = orthonormal(A);
    EXPECT_LE((Q.transpose() * Q - MatX::Identity(A.cols(), A.cols())).norm(), 1e-13);
    EXPECT_LE((A - Q * (Q.transpose() * A)).norm(), 1e-12);
  }
}

TEST(Dense, EigenvaluesOfATurnedDiagonal) {
  std::mt19937 draw(9);
  const MatX Q = random_matrix(5, 5, draw);
  const VecX values{{-7, 0.5, 2, 3, -4}};
  VecX moduli = eigenvalues(Q * values.asDiagonal() * inverse_of(Q)).cwiseAbs();
  std::sort(moduli.begin(), moduli.end());
  EXPECT_LE((moduli - VecX{{0.5, 2, 3, 4, 7}}).norm(), 1e-11);
  const SymmetricEigen eigen = symmetric_eigen(Q + Q.transpose());
  EXPECT_LE(((Q + Q.transpose()) * eigen.vectors - eigen.vectors * eigen.values.asDiagonal()).norm(), 1e-13);
}

}  // namespace
}  // namespace mortise
