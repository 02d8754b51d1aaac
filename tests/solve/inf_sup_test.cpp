// The inf-sup constant on systems small enough to see it.
#include "solve/inf_sup.hpp"

#include <gtest/gtest.h>

namespace mortise {
namespace {

struct SmallProblem {
  SparseMatrix K, B, S;
  std::vector<char> fixed, active;
  VecX scale;
  std::vector<int> grounded;

  InfSup solve() const {
    SaddlePointSystem system{.K = K,
                             .f = {},
                             .constraints = {fixed, {}},
                             .stiffness_scale = 2,
                             .grounded = grounded,
                             .B = B,
                             .g = {},
                             .row_scale = scale,
                             .unilateral = {},
                             .start = {}};
    return inf_sup(system, S, active);
  }
};

SparseMatrix sparse(const MatX& dense) { return dense.sparseView(); }

// Three nodes, two rows, each on an unknown of its own: C = diag(1, 1 / 4).
SmallProblem two_rows() {
  SmallProblem p;
  MatX K = MatX::Identity(6, 6);
  K(0, 0) = 2;  // with 0 and 4 linked the inverse's first entry is 1 / (2 - 1)
  K(4, 0) = 1;
  K(3, 3) = 4;
  p.K = sparse(K);
  MatX B = MatX::Zero(2, 6);
  B(0, 0) = 1;
  B(1, 3) = -1;
  p.B = sparse(B);
  p.S = sparse(MatX::Identity(2, 2));
  p.fixed.assign(6, 0);
  p.active = {1, 1};
  p.scale = Eigen::Vector2d(1, 3);  // of no consequence
  return p;
}

TEST(InfSup, OfADiagonalSystemIsItsSmallestRatio) {
  SmallProblem p = two_rows();
  EXPECT_NEAR(p.solve().beta, 0.5, 1e-12);
  EXPECT_NEAR(p.solve().mode(0), 0, 1e-12);
  EXPECT_NEAR(p.solve().mode(1), 1, 1e-12);
  p.S.coeffRef(0, 0) = 100;  // the first row is now the least controlled: 1 / 100
  EXPECT_NEAR(p.solve().beta, 0.1, 1e-12);
}

TEST(InfSup, RowsThatAreOpenTakeNoPart) {
  SmallProblem p = two_rows();
  p.active = {1, 0};
  EXPECT_NEAR(p.solve().beta, 1, 1e-12);
  EXPECT_EQ(p.solve().mode(1), 0);
  p.active = {0, 0};
  EXPECT_EQ(p.solve().mode.size(), 0);
}

TEST(InfSup, MultipliersThatMoveAFloatingBodyAreHeldByItsMotion) {
  // Unknowns 0 and 2 hang on a spring of stiffness 1 between them and float together: only lambda = (q, -q) deforms
  // them, by C = 1 for q^2 of it against the norm 2 q^2.
  SmallProblem p = two_rows();
  MatX K = MatX::Identity(6, 6);
  K(0, 0) = K(2, 2) = 1;
  K(2, 0) = -1;
  p.K = sparse(K);
  MatX B = MatX::Zero(2, 6);
  B(0, 0) = 1;
  B(1, 2) = 1;
  p.B = sparse(B);
  p.grounded = {0};
  const InfSup found = p.solve();
  EXPECT_NEAR(found.beta, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(found.mode(0) + found.mode(1), 0, 1e-12);
}

}  // namespace
}  // namespace mortise
