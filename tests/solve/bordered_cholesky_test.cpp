// The bordered factorisation against dense algebra: C = B K^-1 B^T, and a solve with any multipliers.
#include "solve/bordered_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "solve/bordered_system.hpp"
#include "solve/split_cholesky.hpp"

namespace mortise {
namespace {

// A random positive definite K of two unknowns a node, in which nodes near one another are coupled, and m rows of B.
struct Dense {
  MatX K, B;
};

Dense random_dense(int nodes, int m, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  Dense d{MatX::Zero(2 * nodes, 2 * nodes), MatX::NullaryExpr(m, 2 * nodes, [&] { return value(random); })};
  for (int i = 0; i < 2 * nodes; ++i)
    for (int j = 0; j < i; ++j)
      if (i / 2 - j / 2 < 3) d.K(i, j) = d.K(j, i) = value(random);
  for (int i = 0; i < 2 * nodes; ++i) d.K(i, i) = 0.1 + d.K.row(i).cwiseAbs().sum();
  return d;
}

// A factor for each part of K, however small.
struct SplitAlways : SplitCholesky {
  SplitAlways(SparseMatrix matrix, const std::vector<int>& blocks) : SplitCholesky(std::move(matrix), blocks, 0) {}
};

template <typename Cholesky>
class BorderedFactor : public testing::Test {};
using Factors = testing::Types<BorderedCholesky, SplitCholesky, SplitAlways>;
TYPED_TEST_SUITE(BorderedFactor, Factors);

template <typename Cholesky>
Cholesky factor_of(const Dense& d) {
  const Eigen::Index n = d.K.rows(), m = d.B.rows();
  MatX bordered = MatX::Zero(n + m, n + m);
  bordered.topLeftCorner(n, n) = d.K.triangularView<Eigen::Upper>();
  bordered.topRightCorner(n, m) = d.B.transpose();
  bordered.bottomRightCorner(m, m).diagonal().setConstant(border_beta);
  std::vector<int> blocks;
  for (int i = 0; i < int(n); ++i) blocks.push_back(i / 2);
  return Cholesky(bordered.sparseView(), blocks);
}

TYPED_TEST(BorderedFactor, ItsByProductIsTheBordersCompliance) {
  for (const int m : {1, 5, 30}) {
    const Dense d = random_dense(40, m, 3);
    TypeParam factor = factor_of<TypeParam>(d);
    ASSERT_EQ(factor.failed_at(), -1);
    const MatX expected = d.B * d.K.inverse() * d.B.transpose();
    const MatX actual = factor.take_border_compliance().template selfadjointView<Eigen::Lower>();
    EXPECT_LE((actual - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff()) << m;
  }
}

TYPED_TEST(BorderedFactor, TakesManyPartsThatOnlyTheBorderJoins) {
  // Small parts in a row; in some the two directions are parts too.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> value(-1, 1);
  for (const bool coupled : {false, true})
    for (const int parts : {4, 10, 30}) {
      const int nodes = 6, n = 2 * nodes * parts, m = 4 * (parts - 1);
      Dense d{MatX::Zero(n, n), MatX::Zero(m, n)};
      for (int p = 0; p < parts; ++p)
        for (int i = 0; i < 2 * nodes; ++i) {
          const int one = 2 * nodes * p + i;
          for (int j = 0; j < i; ++j) {  // a ring of nodes
            const int apart = i / 2 - j / 2;
            if ((apart < 2 || apart == nodes - 1) && (coupled || i % 2 == j % 2))
              d.K(one, one - i + j) = d.K(one - i + j, one) = value(random);
          }
        }
      for (int i = 0; i < n; ++i) d.K(i, i) = 0.1 + d.K.row(i).cwiseAbs().sum();
      for (int row = 0; row < m; ++row) {  // the first two nodes of a part, on the fourth and fifth of the one before
        d.B(row, 2 * nodes * (row / 4 + 1) + row % 4) = 1;
        d.B(row, 2 * nodes * (row / 4) + 6 + row % 4) = -1;
      }
      TypeParam factor = factor_of<TypeParam>(d);
      const MatX inverse = d.K.inverse(), expected = d.B * inverse * d.B.transpose();
      const MatX actual = factor.take_border_compliance().template selfadjointView<Eigen::Lower>();
      EXPECT_LE((actual - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff()) << parts;
      const VecX f = VecX::LinSpaced(n, -1, 2), lambda = VecX::LinSpaced(m, 3, -1), y = factor.forward(f),
                 u = inverse * (f - d.B.transpose() * lambda);
      EXPECT_LE(largest_entry(factor.at_border(y) - d.B * inverse * f), 1e-13 * largest_entry(d.B * inverse * f));
      EXPECT_LE(largest_entry(factor.backward(y, lambda) - u), 1e-13 * largest_entry(u));
    }
}

TYPED_TEST(BorderedFactor, SolvesWithAnyMultipliers) {
  const Dense d = random_dense(40, 6, 5);
  const TypeParam factor = factor_of<TypeParam>(d);
  const MatX inverse = d.K.inverse();
  const VecX f = VecX::LinSpaced(80, -1, 2), lambda = VecX::LinSpaced(6, 3, -1);
  const VecX y = factor.forward(f);
  EXPECT_LE(largest_entry(factor.at_border(y) - d.B * inverse * f), 1e-13 * largest_entry(d.B * inverse * f));
  const VecX u = inverse * (f - d.B.transpose() * lambda);
  EXPECT_LE(largest_entry(factor.backward(y, lambda) - u), 1e-13 * largest_entry(u));
  EXPECT_LE(largest_entry(factor.backward(y, VecX::Zero(6)) - inverse * f), 1e-13 * largest_entry(inverse * f));
}

TYPED_TEST(BorderedFactor, WithoutABorderItIsACholeskySolve) {
  const Dense d = random_dense(10, 0, 7);
  TypeParam factor = factor_of<TypeParam>(d);
  const VecX f = VecX::LinSpaced(20, 1, 2), u = d.K.inverse() * f;
  EXPECT_LE(largest_entry(factor.backward(factor.forward(f), VecX()) - u), 1e-13 * largest_entry(u));
  EXPECT_EQ(factor.take_border_compliance().size(), 0);
}

TYPED_TEST(BorderedFactor, OfNothingIsNothing) {
  for (const int m : {0, 2}) {  // all displacements prescribed, without contact and with it
    TypeParam factor = factor_of<TypeParam>({MatX::Zero(0, 0), MatX::Zero(m, 0)});
    EXPECT_EQ(factor.failed_at(), -1);
    const VecX y = factor.forward(VecX());
    EXPECT_EQ(factor.at_border(y), VecX::Zero(m));
    EXPECT_EQ(factor.backward(y, VecX::Ones(m)).size(), 0);
    EXPECT_EQ(factor.take_border_compliance().size(), m * m);
  }
}

TYPED_TEST(BorderedFactor, NamesTheUnknownWhereKIsNotPositiveDefinite) {
  Dense d = random_dense(10, 2, 9);
  d.K(7, 7) = -1;
  const int at = factor_of<TypeParam>(d).failed_at();
  EXPECT_GE(at, 0);
  EXPECT_LT(at, 20);
}

// ---- The bordered system of bodies: prescribed unknowns left out, springs as more border ----

SaddlePointSystem system_of(const Dense& d) {
  const Eigen::Index n = d.K.rows(), m = d.B.rows();
  return {.K = MatX(d.K.triangularView<Eigen::Lower>()).sparseView(),
          .f = VecX::Zero(n),
          .constraints = {std::vector<char>(n, 0), VecX::Zero(n)},
          .stiffness_scale = 4,
          .grounded = {},
          .B = d.B.sparseView(),
          .g = VecX::Zero(m),
          .row_scale = VecX::LinSpaced(m, 1, 2),
          .unilateral = {},
          .start = {}};
}

TEST(BorderedSystem, IsTheScaledMatrixOfTheFreeUnknownsWithSpringsAsRows) {
  const Dense d = random_dense(6, 3, 11);
  SaddlePointSystem s = system_of(d);
  s.constraints.fixed[2] = s.constraints.fixed[7] = 1;
  s.grounded = {9};
  const BorderedSystem b = bordered_system(s);
  EXPECT_EQ(b.free, (std::vector<int>{0, 1, 3, 4, 5, 6, 8, 9, 10, 11}));
  EXPECT_EQ(b.blocks, (std::vector<int>{0, 0, 1, 2, 2, 3, 4, 4, 5, 5}));
  MatX expected = MatX::Zero(14, 14);
  expected.topLeftCorner(10, 10) = MatX(d.K(b.free, b.free) / 4).triangularView<Eigen::Upper>();
  expected(7, 7) += 1;  // the spring, at unknown 9
  for (int a = 0; a < 3; ++a) expected.col(10 + a).head(10) = d.B(a, b.free).transpose() / s.row_scale(a);
  expected(7, 13) = 1;
  expected.diagonal().tail(4).setConstant(border_beta);
  EXPECT_EQ(MatX(b.matrix), expected);
}

TEST(BorderedSystem, OfAPartOfTheBodiesLeavesTheOthersOut) {
  const Dense d = random_dense(4, 2, 13);
  const BorderedSystem part = bordered_system(system_of(d), {1, 1, 1, 1, 0, 0, 0, 0}, {});
  EXPECT_EQ(part.free, (std::vector<int>{4, 5, 6, 7}));
  EXPECT_EQ(part.matrix.cols(), 6);
}

}  // namespace
}  // namespace mortise
