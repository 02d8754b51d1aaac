#include "solve/direct.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

namespace mortise {
namespace {

// A chain of nodes with two unknowns each: positive definite but for what its end leaves free.
SparseMatrix chain_stiffness(int nodes) {
  std::vector<Eigen::Triplet<double>> entries;
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

struct Problem {
  SparseMatrix K, B;
  VecX f, g, value, scale;
  std::vector<char> fixed;
  double stiffness = 1;

  SaddlePointSystem system(std::vector<int> grounded = {}) const {
    return {.K = K,
            .f = f,
            .constraints = {fixed, value},
            .stiffness_scale = stiffness,
            .grounded = std::move(grounded),
            .B = B,
            .g = g,
            .row_scale = scale,
            .unilateral = {},
            .start = {}};
  }
};

// Two chains; the second one floats (all of it may move by (1, 1)) until B holds it.
Problem two_chains(bool with_constraints) {
  const int nodes = 12;
  const SparseMatrix one = chain_stiffness(nodes);
  Problem p;
  std::vector<Eigen::Triplet<double>> entries, rows;
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
  p.scale = VecX::Ones(p.B.rows());
  p.fixed.assign(4 * nodes, 0);
  p.value = VecX::Zero(4 * nodes);
  p.fixed[0] = 1;
  p.value(0) = 0.25;
  return p;
}

Solution solve(const Problem& p, std::vector<int> grounded) { return solve_directly(p.system(std::move(grounded))); }

// The same system, dense and by LU with full pivoting.
VecX dense_solution(const Problem& p) {
  const Eigen::Index n = p.K.rows(), m = p.B.rows();
  MatX A = MatX::Zero(n + m, n + m);
  A.topLeftCorner(n, n) = MatX(p.K).selfadjointView<Eigen::Lower>();
  A.bottomLeftCorner(m, n) = MatX(p.B);
  A.topRightCorner(n, m) = MatX(p.B).transpose();
  VecX rhs(n + m);
  rhs << p.f, p.g;
  for (Eigen::Index i = 0; i < n; ++i)
    if (p.fixed[i]) {
      A.row(i).setZero();
      A(i, i) = 1;
      rhs(i) = p.value(i);
    }
  return A.fullPivLu().solve(rhs);
}

TEST(Direct, AgreesWithADenseSolverWhereBHoldsAFloatingBody) {
  const Problem p = two_chains(true);
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
  const Problem p = two_chains(true);
  const VecX a = solve(p, {24}).u, b = solve(p, {41}).u;
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 1e-10 * a.cwiseAbs().maxCoeff());
}

TEST(Direct, ScalesDoNotChangeTheAnswer) {
  Problem p = two_chains(true);
  const Solution a = solve(p, {24});
  p.K *= 2e11;
  p.f *= 2e11;
  p.B = SparseMatrix(1e-3 * p.B);
  p.g *= 1e-3;
  p.scale *= 1e-3;
  p.stiffness = 2e11;
  const Solution b = solve(p, {24});
  EXPECT_LE((a.u - b.u).cwiseAbs().maxCoeff(), 1e-12 * a.u.cwiseAbs().maxCoeff());
  EXPECT_LE((a.lambda - b.lambda / 2e14).cwiseAbs().maxCoeff(), 1e-10 * a.lambda.cwiseAbs().maxCoeff());
}

TEST(Direct, WithoutConstraintsItIsACholeskySolve) {
  Problem p = two_chains(false);
  p.fixed[24] = 1;
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
  Problem p = two_chains(true);
  SparseMatrix twice(6, p.B.cols());
  std::vector<Eigen::Triplet<double>> rows;
  for (int j = 0; j < p.B.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(p.B, j); it; ++it) {
      rows.emplace_back(int(it.row()), j, it.value());
      if (it.row() == 2) rows.emplace_back(5, j, 2 * it.value());
    }
  twice.setFromTriplets(rows.begin(), rows.end());
  p.B = twice;
  p.g = VecX::Zero(6);
  p.scale = VecX::Ones(6);
  const Solution s = solve(p, {24});
  EXPECT_EQ(s.status, SolveStatus::dependent_row);
  EXPECT_EQ(s.failed_at, 5);
}

// ---- Residuals: what they see, and what they must not lose ----

TEST(Direct, AResidualOfWhatIsNotFiniteIsNotANumber) {
  const Problem p = two_chains(true);
  const SaddlePointSystem system = p.system({24});
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
    Problem p = two_chains(true);
    p.f(7) = bad;
    EXPECT_EQ(solve(p, {24}).status, SolveStatus::not_converged);
    p = two_chains(true);
    p.g(1) = bad;
    EXPECT_EQ(solve(p, {24}).status, SolveStatus::not_converged);
    p = two_chains(true);
    p.value(0) = bad;
    EXPECT_EQ(solve(p, {24}).status, SolveStatus::not_converged);
    p = two_chains(false);
    p.fixed[24] = 1;
    p.f(30) = bad;
    EXPECT_EQ(solve(p, {}).status, SolveStatus::not_converged) << "without contact";
  }
}

// Springs of very different stiffness, as thin elements make them: node to node 1e8 along, 1 across.
Problem stiff_chain() {
  Problem p = two_chains(false);
  for (int j = 0; j < p.K.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(p.K, j); it; ++it)
      if (it.row() % 2 == 0 && j % 2 == 0) it.valueRef() *= 1e8;
  for (const int i : {24, 47}) p.fixed[i] = 1;
  p.value(24) = 0.25;
  return p;
}

TEST(Direct, RoundOffOfStiffElementsIsNoResidual) {
  const Solution s = solve(stiff_chain(), {});
  EXPECT_LE(s.force_residual, 1e-11);
}

TEST(Direct, AWrongDisplacementIsAResidual) {
  for (const Problem& p : {two_chains(true), stiff_chain()}) {
    const SaddlePointSystem system = p.system();
    Solution s = p.B.rows() > 0 ? solve(p, {24}) : solve(p, {});
    const VecX u = s.u;
    const bool stiff = p.B.rows() == 0;  // across, its springs are nothing beside the forces along
    for (Eigen::Index i = 0; i < u.size(); i += stiff ? 2 : 1) {
      if (p.fixed[i]) continue;
      s.u = u;
      s.u(i) += 1e-8 * largest_entry(u);
      measure_residuals(system, s);
      EXPECT_GT(s.force_residual, 1e-10) << i;
    }
  }
}

}  // namespace
}  // namespace mortise
