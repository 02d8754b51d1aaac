// The bordered factorisation against dense algebra: C = B K^-1 B^T, and a solve with any multipliers.
#include "solve/bordered_cholesky.hpp"

#include <gtest/gtest.h>

#include <random>

#include "base/dense.hpp"
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
    const MatX expected = d.B * inverse_of(d.K) * d.B.transpose();
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
      const MatX inverse = inverse_of(d.K), expected = d.B * inverse * d.B.transpose();
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
  const MatX inverse = inverse_of(d.K);
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
  const VecX f = VecX::LinSpaced(20, 1, 2), u = inverse_of(d.K) * f;
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

// ---- Halves of large bodies ----

// A random positive definite matrix on a grid of nodes, two unknowns each, coupled as by quadrilaterals of four nodes.
MatX random_mesh_matrix(int columns, int rows, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  const int nodes = columns * rows;
  MatX K = MatX::Zero(2 * nodes, 2 * nodes);
  for (int i = 0; i < 2 * nodes; ++i)
    for (int j = 0; j < i; ++j)
      if (std::abs(i / 2 % columns - j / 2 % columns) < 2 && i / 2 / columns - j / 2 / columns < 2)
        K(i, j) = K(j, i) = value(random);
  for (int i = 0; i < 2 * nodes; ++i) K(i, i) = 0.1 + K.row(i).cwiseAbs().sum();
  return K;
}

double largest_of(const MatX& values) { return largest_entry(values.reshaped()); }

// Compliance and a solution with multipliers, to 1e-10 of one factor for all.
void expect_as_one(const Dense& d, SplitCholesky split) {
  BorderedCholesky one = factor_of<BorderedCholesky>(d);
  ASSERT_EQ(split.failed_at(), -1);
  const Eigen::Index n = d.K.rows(), m = d.B.rows();
  const MatX f = MatX::Random(n, 2), lambda = MatX::Random(m, 2);
  MatX y(split.size(), 2), u(n, 2);
  for (int k = 0; k < 2; ++k) {
    const VecX y_one = one.forward(f.col(k)), load = f.col(k);
    y.col(k) = split.forward(load);
    EXPECT_LE(largest_entry(split.at_border(y.col(k)) - one.at_border(y_one)), 1e-10 * largest_of(f));
    u.col(k) = one.backward(y_one, lambda.col(k));
  }
  EXPECT_LE(largest_of(split.backward(y, lambda) - u), 1e-10 * largest_of(u));
  const MatX duals = one.backward(MatX::Zero(n + m, 2), lambda);  // of the multipliers alone
  EXPECT_LE(largest_of(split.backward(MatX::Zero(split.size(), 2), lambda) - duals), 1e-10 * largest_of(duals));
  const MatX expected = one.take_border_compliance().selfadjointView<Eigen::Lower>(),
             actual = split.take_border_compliance().selfadjointView<Eigen::Lower>();
  EXPECT_LE(largest_of(actual - expected), 1e-10 * largest_of(expected));
}

MatX beside_each_other(const MatX& A, const MatX& B) {
  MatX K = MatX::Zero(A.rows() + B.rows(), A.rows() + B.rows());
  K.topLeftCorner(A.rows(), A.rows()) = A;
  K.bottomRightCorner(B.rows(), B.rows()) = B;
  return K;
}

constexpr int halve_from = 400;

SplitCholesky halved(const Dense& d, int dissect = 0) {
  std::vector<int> blocks;
  const Eigen::Index n = d.K.rows(), m = d.B.rows();
  for (int i = 0; i < int(n); ++i) blocks.push_back(i / 2);
  MatX bordered = MatX::Zero(n + m, n + m);
  bordered.topLeftCorner(n, n) = d.K.triangularView<Eigen::Upper>();
  bordered.topRightCorner(n, m) = d.B.transpose();
  bordered.bottomRightCorner(m, m).diagonal().setConstant(border_beta);
  return SplitCholesky(bordered.sparseView(), blocks, halve_from, dissect);
}

TEST(SplitFactor, HalvesALargeBody) {
  const MatX K = random_mesh_matrix(20, 13, 17);
  for (const int m : {0, 7}) {
    const Dense d{K, MatX::Random(m, K.rows())};
    const SplitCholesky factor = halved(d);
    EXPECT_GT(factor.separators(), 0);
    EXPECT_LT(factor.separators(), K.rows() / 5);
    expect_as_one(d, halved(d));
  }
}

TEST(SplitFactor, HalvesTheLargeOneOfTwoBodiesThatABorderJoins) {
  // Rows that reach the large body alone, the small one alone, both, and one node.
  const MatX K = beside_each_other(random_mesh_matrix(20, 13, 19), random_mesh_matrix(9, 8, 23));
  MatX B = MatX::Random(12, K.rows());
  B.topRows(3).rightCols(2 * 9 * 8).setZero();
  B.middleRows(3, 3).leftCols(2 * 20 * 13).setZero();
  B.row(11).setZero();
  B(11, 4) = 1;
  const Dense d{K, B};
  EXPECT_GT(halved(d).separators(), 0);
  expect_as_one(d, halved(d));
}

TEST(SplitFactor, LeavesABodyWholeThatIsTooSmall) {
  const Dense d{beside_each_other(random_mesh_matrix(13, 12, 29), random_mesh_matrix(13, 12, 31)),
                MatX::Random(5, 4 * 13 * 12)};
  EXPECT_EQ(halved(d).separators(), 0);
  expect_as_one(d, halved(d));
}

TEST(SplitFactor, TakesAnEmptySeparatorAndAnEmptyHalf) {
  const Dense d{random_mesh_matrix(20, 13, 43), MatX::Random(5, 2 * 20 * 13)};
  constexpr int never = 1 << 30;  // by minimum degree there is nothing to separate
  EXPECT_EQ(halved(d, never).separators(), 0);
  expect_as_one(d, halved(d, never));
}

TEST(SplitFactor, SeparatesWhatTheSecondUnknownOfANodeIsCoupledTo) {
  // The order knows couplings of a node's first unknown alone: here the second ones reach across the whole body.
  Dense d{random_mesh_matrix(20, 13, 37), MatX::Random(3, 2 * 20 * 13)};
  for (int i = 1; i < 60; i += 2) d.K(i, 2 * 20 * 13 - i) = d.K(2 * 20 * 13 - i, i) = 0.05;
  expect_as_one(d, halved(d));
}

TEST(SplitFactor, NamesTheUnknownWhereKIsNotPositiveDefinite) {
  Dense d{random_mesh_matrix(20, 13, 41), MatX::Random(3, 2 * 20 * 13)};
  for (int at = 0; at < 520; at += 13) {  // in either half and in the separator
    const double pivot = d.K(at, at);
    d.K(at, at) = -1;
    EXPECT_EQ(halved(d).failed_at(), at);
    d.K(at, at) = pivot;
  }
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
