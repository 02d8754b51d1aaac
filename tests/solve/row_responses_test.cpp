#include "solve/row_responses.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mortise {
namespace {

// K = tridiag in two directions of a grid n by n, whose factor has more entries an unknown than there are rows of B.
BorderedCholesky grid(int n, int rows) {
  Triplets entries;
  const int size = n * n;
  for (int i = 0; i < size; ++i) {
    entries.emplace_back(i, i, 4.1);
    if (i % n > 0) entries.emplace_back(i - 1, i, -1);
    if (i >= n) entries.emplace_back(i - n, i, -1);
  }
  for (int r = 0; r < rows; ++r) {
    entries.emplace_back(7 * r, size + r, 1);
    entries.emplace_back(size + r, size + r, border_beta);
  }
  SparseMatrix matrix(size + rows, size + rows);
  matrix.setFromTriplets(entries.begin(), entries.end());
  std::vector<int> blocks;
  for (int i = 0; i < size; ++i) blocks.push_back(i / 2);
  return BorderedCholesky(std::move(matrix), blocks);
}

// Few rows, which become known, and more than are kept.
TEST(RowResponses, AreThoseOfTheFactor) {
  const int rows = 40;
  const BorderedCholesky factor = grid(20, rows);
  EXPECT_LT(factor.entries() / factor.unknowns(), rows);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  RowResponses responses;
  for (int k = 0; k < 60; ++k) {
    const int touched = k % 10 == 9 ? rows : 1 + k / 10;
    MatX lambda = MatX::Zero(rows, 1 + k % 3);
    for (int i = 0; i < touched; ++i)
      for (Eigen::Index j = 0; j < lambda.cols(); ++j) lambda(touched == rows ? i : 5 * i, j) = normal(random);
    const MatX exact = factor.backward(MatX::Zero(factor.size(), lambda.cols()), lambda);
    EXPECT_LE((responses.at(factor, lambda) - exact).norm(), 1e-13 * exact.norm()) << k;
  }
  EXPECT_GE(responses.known(), 5);
  EXPECT_LE(responses.known(), factor.entries() / factor.unknowns());
  EXPECT_EQ(responses.at(factor, MatX::Zero(rows, 2)).norm(), 0);
}

// What is asked once costs no more than a substitution.
TEST(RowResponses, AreKeptWhereTheyPay) {
  const BorderedCholesky factor = grid(20, 10);
  RowResponses responses;
  const MatX lambda = MatX::Ones(10, 3);
  for (const int known : {0, 0, 0, 0, 10, 10}) {
    responses.at(factor, lambda);
    EXPECT_EQ(responses.known(), known);
  }
}

}  // namespace
}  // namespace mortise
