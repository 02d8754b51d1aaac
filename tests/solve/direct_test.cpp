#include "solve/direct.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

namespace mortise {
namespace {

// A chain of nodes with two unknowns each: positive definite but for what its end leaves free.
SparseMatrix chain_stiffness(int nodes) {
  Triplets entries;
  for (int i = 0; i + 1 < nodes; ++i)
    for (int c = 0; c < 2; ++c) {
      const int a = 2 * i + c, b = a + 2;
      const double k = 1 + 0.1 * i + c;
      entries.emplace_back(a, a, k);
      entries.emplace_back(b, b, k);
      entries.emplace_back(b, a, -k);
    }
  for (int i = 0; i < nodes; ++i) {  // couples both components of a node without holding them
    entries.emplace_back(2 * i, 2 * i, 0.3);
    entries.emplace_back(2 * i + 1, 2 * i + 1, 0.3);
    entries.emplace_back(2 * i + 1, 2 * i, -0.3);
  }
  SparseMatrix K(2 * nodes, 2 * nodes);
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

// Two chains; the second one floats (all of it may move by (1, 1)) until B holds it.
SaddlePointSystem two_chains(bool with_constraints) {
  const int nodes = 12;
  const SparseMatrix one = chain_stiffness(nodes);
  SaddlePointSystem p;
  Triplets entries, rows;
  for (int block = 0; block < 2; ++block)
    for (int j = 0; j < one.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(one, j); it; ++it)
        entries.emplace_back(2 * nodes * block + int(it.row()), 2 * nodes * block + j, it.value());
  p.K.resize(4 * nodes, 4 * nodes);
  p.K.setFromTriplets(entries.begin(), entries.end());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  if (with_constraints)
    for (int r = 0; r < 5; ++r)
      for (int k = 0; k < 4; ++k) {
        rows.emplace_back(r, 2 * (2 * r + k / 2) + k % 2, value(random));
        rows.emplace_back(r, 2 * nodes + 2 * (2 * r + k / 2) + k % 2, value(random));
      }
  p.B.resize(with_constraints ? 5 : 0, 4 * nodes);
  p.B.setFromTriplets(rows.begin(), rows.end());
  p.f = VecX::NullaryExpr(4 * nodes, [&] { return value(random); });
  p.g = VecX::NullaryExpr(p.B.rows(), [&] { return value(random); });
  p.row_scale = VecX::Ones(p.B.rows());
  p.constraints.fixed.assign(4 * nodes, 0);
  p.constraints.value = VecX::Zero(4 * nodes);
  p.constraints.fixed[0] = 1;
  p.constraints.value(0) = 0.25;
  return p;
}

Solution solve(SaddlePointSystem p, std::vector<int> grounded) {
  p.grounded = std::move(grounded);
  return solve_directly(p);
}

// The same system, dense and by LU with full pivoting.
VecX dense_solution(const SaddlePointSystem& p) {
  const Eigen::Index n = p.K.rows(), m = p.B.rows();
  MatX A = MatX::Zero(n + m, n + m);
  A.topLeftCorner(n, n) = MatX(p.K).selfadjointView<Eigen::Lower>();
  A.bottomLeftCorner(m, n) = MatX(p.B);
  A.topRightCorner(n, m) = MatX(p.B).transpose();
  VecX rhs(n + m);
  rhs << p.f, p.g;
  for (Eigen::Index i = 0; i < n; ++i)
    if (p.constraints.fixed[i]) {
      A.row(i).setZero();
      A(i, i) = 1;
      rhs(i) = p.constraints.value(i);
    }
  return A.partialPivLu().solve(rhs);
}

TEST(Direct, AgreesWithADenseSolverWhereBHoldsAFloatingBody) {
  const SaddlePointSystem p = two_chains(true);
  const Solution s = solve(p, {24});  // a spring at the second chain's first unknown
  ASSERT_EQ(s.status, SolveStatus::converged);
  VecX all(s.u.size() + s.lambda.size());
  all << s.u, s.lambda;
  const VecX exact = dense_solution(p);
  EXPECT_LE((all - exact).cwiseAbs().maxCoeff(), 1e-10 * exact.cwiseAbs().maxCoeff());
  EXPECT_LE(s.force_residual, 1e-12);
  EXPECT_LE(s.constraint_residual, 1e-12);
}

TEST(Direct, DoesNotDependOnWhichUnknownIsGrounded) {
  const SaddlePointSystem p = two_chains(true);
  const VecX a = solve(p, {24}).u, b = solve(p, {41}).u;
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 1e-10 * a.cwiseAbs().maxCoeff());
}

TEST(Direct, ScalesDoNotChangeTheAnswer) {
  SaddlePointSystem p = two_chains(true);
  const Solution a = solve(p, {24});
  p.K *= 2e11;
  p.f *= 2e11;
  p.B = SparseMatrix(1e-3 * p.B);
  p.g *= 1e-3;
  p.row_scale *= 1e-3;
  p.stiffness_scale = 2e11;
  const Solution b = solve(p, {24});
  EXPECT_LE((a.u - b.u).cwiseAbs().maxCoeff(), 1e-12 * a.u.cwiseAbs().maxCoeff());
  EXPECT_LE((a.lambda - b.lambda / 2e14).cwiseAbs().maxCoeff(), 1e-10 * a.lambda.cwiseAbs().maxCoeff());
}

TEST(Direct, WithoutConstraintsItIsACholeskySolve) {
  SaddlePointSystem p = two_chains(false);
  p.constraints.fixed[24] = 1;
  const Solution s = solve(p, {});
  ASSERT_EQ(s.status, SolveStatus::converged);
  EXPECT_LE((s.u - dense_solution(p)).cwiseAbs().maxCoeff(), 1e-11 * s.u.cwiseAbs().maxCoeff());
}

TEST(Direct, NamesTheUnknownThatNothingHolds) {
  const Solution s = solve(two_chains(false), {});
  EXPECT_EQ(s.status, SolveStatus::not_positive_definite);
  EXPECT_GE(s.failed_at, 24);  // in the second chain
}

TEST(Direct, NamesTheRowThatFollowsFromOthers) {
  SaddlePointSystem p = two_chains(true);
  SparseMatrix twice(6, p.B.cols());
  Triplets rows;
  for (int j = 0; j < p.B.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(p.B, j); it; ++it) {
      rows.emplace_back(int(it.row()), j, it.value());
      if (it.row() == 2) rows.emplace_back(5, j, 2 * it.value());
    }
  twice.setFromTriplets(rows.begin(), rows.end());
  p.B = twice;
  p.g = VecX::Zero(6);
  p.row_scale = VecX::Ones(6);
  const Solution s = solve(p, {24});
  EXPECT_EQ(s.status, SolveStatus::dependent_row);
  EXPECT_EQ(s.failed_at, 5);
}

TEST(Direct, WhereAllIsPrescribedTheDisplacementsAreGiven) {
  SaddlePointSystem p = two_chains(false);
  p.constraints = {std::vector<char>(p.f.size(), 1), VecX::LinSpaced(p.f.size(), -1, 2)};
  const Solution s = solve(p, {});
  ASSERT_EQ(s.status, SolveStatus::converged);
  EXPECT_EQ(s.u, p.constraints.value);

  p = two_chains(true);
  p.constraints.fixed.assign(p.f.size(), 1);
  EXPECT_EQ(solve(p, {}).status, SolveStatus::dependent_row);
}

// ---- Residuals: what they see, and what they must not lose ----

TEST(Direct, AResidualOfWhatIsNotFiniteIsNotANumber) {
  SaddlePointSystem system = two_chains(true);
  system.grounded = {24};
  const Solution good = solve_directly(system);
  for (const double bad : {std::nan(""), HUGE_VAL, 1e308}) {  // of the last the products overflow
    Solution s = good;
    s.u(30) = bad;
    measure_residuals(system, s);
    EXPECT_TRUE(std::isnan(s.force_residual)) << bad;
    s = good;
    s.u(20) = bad;
    s.active[0] = 0;
    measure_residuals(system, s);
    EXPECT_TRUE(std::isnan(s.force_residual) || std::isnan(s.constraint_residual)) << bad;
    s = good;
    s.lambda(2) = std::isnan(bad) ? bad : HUGE_VAL;
    measure_residuals(system, s);
    EXPECT_TRUE(std::isnan(s.force_residual)) << bad;
  }
}

TEST(Direct, LoadsThatAreNotFiniteAreNotSolved) {
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    SaddlePointSystem p = two_chains(true);
    p.f(7) = bad;
    EXPECT_EQ(solve(p, {24}).status, SolveStatus::not_converged);
    p = two_chains(true);
    p.g(1) = bad;
    EXPECT_EQ(solve(p, {24}).status, SolveStatus::not_converged);
    p = two_chains(true);
    p.constraints.value(0) = bad;
    EXPECT_EQ(solve(p, {24}).status, SolveStatus::not_converged);
    p = two_chains(false);
    p.constraints.fixed[24] = 1;
    p.f(30) = bad;
    EXPECT_EQ(solve(p, {}).status, SolveStatus::not_converged) << "without contact";
  }
}

// Springs of very different stiffness, as thin elements make them: node to node 1e8 along, 1 across.
SaddlePointSystem stiff_chain() {
  SaddlePointSystem p = two_chains(false);
  for (int j = 0; j < p.K.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(p.K, j); it; ++it)
      if (it.row() % 2 == 0 && j % 2 == 0) it.valueRef() *= 1e8;
  for (const int i : {24, 47}) p.constraints.fixed[i] = 1;
  p.constraints.value(24) = 0.25;
  return p;
}

TEST(Direct, RoundOffOfStiffElementsIsNoResidual) {
  const Solution s = solve(stiff_chain(), {});
  EXPECT_LE(s.force_residual, 1e-11);
}

TEST(Direct, AWrongDisplacementIsAResidual) {
  for (const SaddlePointSystem& p : {two_chains(true), stiff_chain()}) {
    Solution s = p.B.rows() > 0 ? solve(p, {24}) : solve(p, {});
    const VecX u = s.u;
    const bool stiff = p.B.rows() == 0;  // across, its springs are nothing beside the forces along
    for (Eigen::Index i = 0; i < u.size(); i += stiff ? 2 : 1) {
      if (p.constraints.fixed[i]) continue;
      s.u = u;
      s.u(i) += 1e-8 * largest_entry(u);
      measure_residuals(p, s);
      EXPECT_GT(s.force_residual, 1e-10) << i;
    }
  }
}

}  // namespace
}  // namespace mortise
