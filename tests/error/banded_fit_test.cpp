// Least squares with banded rows, against dense ones.
#include "error/banded_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace mortise {
namespace {

struct FittedRows {
  BandedFit fit{6, 3};
  MatX dense = MatX::Zero(9, 6);
  VecX right = VecX::Zero(9);

  FittedRows() {
    for (Eigen::Index i = 0; i < 9; ++i) {
      const Eigen::Index first = std::min<Eigen::Index>(i / 2, 3);
      const VecX row = Eigen::Vector3d(std::sin(1.0 + i), 2 + std::cos(3.0 * i), std::sin(0.4 * i * i));
      dense.row(i).segment(first, 3) = row;
      right(i) = std::cos(5.0 * i);
      fit.add(first, row, right(i));
    }
  }
};

TEST(BandedFit, IsTheLeastSumOfSquares) {
  const FittedRows rows;
  const VecX x = rows.dense.colPivHouseholderQr().solve(rows.right);
  EXPECT_LE((rows.fit.solve() - x).norm(), 1e-13 * x.norm());
}

TEST(BandedFit, KeepsWhatIsAskedExactly) {
  const FittedRows rows;
  const VecX g = VecX::LinSpaced(6, 1, -2);
  const VecX x = rows.fit.solve(g, 0.7);
  EXPECT_NEAR(g.dot(x), 0.7, 1e-13);
  // The gradient is along g: nothing else of it is left.
  const VecX gradient = rows.dense.transpose() * (rows.dense * x - rows.right);
  EXPECT_LE((gradient - g * (g.dot(gradient) / g.squaredNorm())).norm(), 1e-13 * rows.right.norm());
}

TEST(BandedFit, IsEmptyWhereRowsLeaveAPartOpen) {
  BandedFit fit(3, 2);
  fit.add(0, Eigen::Vector2d(1, 1), 1);
  fit.add(1, Eigen::Vector2d(1, 1), 1);
  EXPECT_EQ(fit.solve().size(), 0);
  fit.add(2, VecX::Ones(1), 1);
  EXPECT_LE((fit.solve() - Eigen::Vector3d(1, 0, 1)).norm(), 1e-15);
}

}  // namespace
}  // namespace mortise
