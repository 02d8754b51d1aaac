// Block SSOR for saddle-point systems: a step by hand, the region of convergence, and the direct solver's answer.
#include "preprint_solvers/mssor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/dense.hpp"
#include "preprint_solvers/band_order.hpp"
#include "preprint_solvers/mssor_sweeps.hpp"
#include "preprint_solvers/relaxation.hpp"
#include "preprint_solvers/tau_limit.hpp"
#include "solve/direct.hpp"

namespace mortise {
namespace {

using Status = SolveStatus;

SparseMatrix sparse(const MatX& dense) { return dense.sparseView(); }

// K = [2 -1; -1 2], one row that says that both are equal but for a gap; f pushes the one that the sweeps begin with.
SaddlePointSystem by_hand() {
  SaddlePointSystem p;
  p.K = sparse((MatX(2, 2) << 2, 0, -1, 2).finished());
  const int first = band_order(p.K)[0];
  const double sign = first == 0 ? 1 : -1;
  p.B = sparse((MatX(1, 2) << sign, -sign).finished());
  p.f = VecX::Unit(2, first);
  p.g = VecX::Constant(1, 0.5);
  p.constraints.value = VecX::Zero(2);
  p.row_scale = VecX::Ones(1);
  p.constraints.fixed = {0, 0};
  return p;
}

// Two chains of nodes in two unknowns a node, each spring of its own stiffness; the first is held at one end, the
// second (it may move by (1, 1)) by the rows of B alone.
SaddlePointSystem two_long_chains(int nodes = 12, int rows = 5) {
  SaddlePointSystem p;
  Triplets entries, of_rows;
  const auto spring = [&](int a, int b, double k) {
    entries.emplace_back(a, a, k);
    entries.emplace_back(b, b, k);
    entries.emplace_back(std::max(a, b), std::min(a, b), -k);
  };
  for (int first : {0, 2 * nodes})
    for (int i = 0; i < nodes; ++i) {
      spring(first + 2 * i, first + 2 * i + 1, 0.3);
      for (int c = 0; c < 2 && i + 1 < nodes; ++c) spring(first + 2 * i + c, first + 2 * i + c + 2, 1 + 0.1 * i + c);
    }
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int r = 0; r < rows; ++r)
    for (int k = 0; k < 8; ++k) of_rows.emplace_back(r, 2 * nodes * (k / 4) + 4 * r + k % 4, number(random));
  p.K.resize(4 * nodes, 4 * nodes);
  p.K.setFromTriplets(entries.begin(), entries.end());
  p.B.resize(rows, 4 * nodes);
  p.B.setFromTriplets(of_rows.begin(), of_rows.end());
  p.f = VecX::NullaryExpr(4 * nodes, [&] { return number(random); });
  p.g = VecX::NullaryExpr(rows, [&] { return number(random); });
  p.row_scale = VecX::Ones(rows);
  p.constraints.value = VecX::Zero(4 * nodes);
  p.constraints.fixed.assign(4 * nodes, 0);
  p.constraints.fixed[0] = p.constraints.fixed[1] = 1;
  p.constraints.value(0) = 0.25;
  return p;
}

// For the direct solver: a spring at the second chain's first unknown.
SaddlePointSystem grounded(SaddlePointSystem p) {
  p.grounded = {24};
  return p;
}

Solution run_mssor(const SaddlePointSystem& p, Acceleration acceleration, double omega, double tau,
                   double tolerance = 1e-11) {
  return solve_by_mssor(p, {omega, tau, acceleration, tolerance, 200000});
}

double difference(const VecX& a, const VecX& b) { return largest_entry(a - b) / largest_entry(b); }

// Q of the reduced system, dense, column by column: the inverse of solve_Q.
MatX inverse_Q(const SweepSystem& s, double omega) {
  MatX inverse(s.n(), s.n());
  for (Eigen::Index k = 0; k < s.n(); ++k) {
    VecX column = VecX::Unit(s.n(), k);
    solve_Q(s, omega, column);
    inverse.col(k) = column;
  }
  return inverse;
}

MatX dense_A(const SweepSystem& s) {
  const Eigen::Index size = s.n() + s.m();
  MatX A(size, size);
  VecX column(size);
  for (Eigen::Index k = 0; k < size; ++k) {
    multiply(s, VecX::Unit(size, k), column);
    A.col(k) = column;
  }
  return A;
}

MatX dense_S(const SweepSystem& s) { return MatX(s.B) * s.D.cwiseInverse().asDiagonal() * MatX(s.B).transpose(); }

// Largest modulus of the eigenvalues of the stationary iteration, I - M^-1 A.
double spectral_radius(const SweepSystem& s, double omega, double tau) {
  SweepPreconditioner M{s, omega, tau};
  MatX step = dense_A(s);
  for (Eigen::Index k = 0; k < step.cols(); ++k) {
    VecX z(step.rows());
    M.solve(step.col(k), z);
    step.col(k) = -z;
    step(k, k) += 1;
  }
  return eigenvalues(step).cwiseAbs().maxCoeff();
}

TEST(Mssor, AStepByHand) {
  // omega = 1: Q = (D + L) D^-1 (D + L^T) = [2 -1; -1 5/2], Q^-1 = [5 2; 2 4] / 8; S = 1/2 + 1/2 = 1; tau = 1/2.
  // u' = Q^-1 f = (5/8, 1/4); lambda = (5/8 - 1/4 - 1/2) / 2 = -1/16;
  // u = u' - Q^-1 (1, -1) lambda = u' + (3/8, -1/4) / 16 = (83/128, 15/64).
  const SaddlePointSystem p = by_hand();
  const SweepSystem s = sweep_system(p);
  SweepPreconditioner M{s, 1, 0.5};
  VecX z(3);
  M.solve(s.rhs, z);
  EXPECT_NEAR(z(0), 83.0 / 128, 1e-15);
  EXPECT_NEAR(z(1), 15.0 / 64, 1e-15);
  EXPECT_NEAR(z(2), -1.0 / 16, 1e-15);
  const Solution one = solve_by_mssor(p, {1, 0.5, Acceleration::none, 1e-10, 1});
  EXPECT_EQ(one.status, Status::not_converged);
  EXPECT_EQ(one.iteration->steps, 1);
  EXPECT_NEAR(one.u(s.unknown[0]), 83.0 / 128, 1e-15);
  EXPECT_NEAR(one.lambda(0), -1.0 / 16, 1e-15);
}

TEST(Mssor, QIsSymmetricAndAboveK) {
  const SweepSystem s = sweep_system(two_long_chains());
  const MatX K = dense_A(s).topLeftCorner(s.n(), s.n());
  for (const double omega : {0.2, 1.0, 1.3, 1.9}) {
    const MatX inverse = inverse_Q(s, omega), Q = inverse_of(inverse);
    EXPECT_LE((inverse - inverse.transpose()).cwiseAbs().maxCoeff(), 1e-14 * inverse.cwiseAbs().maxCoeff());
    // the definition, from D and L
    MatX lower = K.triangularView<Eigen::StrictlyLower>();
    lower *= omega;
    lower.diagonal() = s.D;
    const MatX defined = lower * s.D.cwiseInverse().asDiagonal() * lower.transpose() / (omega * (2 - omega));
    EXPECT_LE((Q - defined).cwiseAbs().maxCoeff(), 1e-11 * defined.cwiseAbs().maxCoeff()) << omega;
    EXPECT_GE(symmetric_eigen(defined - K).values.minCoeff(), -1e-12) << omega;
  }
}

TEST(Mssor, MIsTheFactoredMatrix) {
  const SweepSystem s = sweep_system(two_long_chains());
  const double omega = 1.3, tau = 0.6;
  const Eigen::Index n = s.n(), m = s.m();
  MatX M(n + m, n + m);
  const MatX inverse = inverse_Q(s, omega), B = s.B;
  M << inverse_of(inverse), B.transpose(), B, B * inverse * B.transpose() - dense_S(s) / tau;
  SweepPreconditioner preconditioner{s, omega, tau};
  for (Eigen::Index k = 0; k < n + m; ++k) {
    VecX z(n + m);
    preconditioner.solve(M.col(k), z);
    EXPECT_LE(largest_entry(z - VecX::Unit(n + m, k)), 1e-11) << k;
  }
}

TEST(Mssor, AgreesWithTheDirectSolverWhereBHoldsAFloatingBody) {
  const SaddlePointSystem p = two_long_chains();
  const Solution direct = solve_directly(grounded(p));
  for (const Acceleration acceleration : {Acceleration::none, Acceleration::krylov, Acceleration::minres})
    for (const double omega : {0.8, 1.3}) {
      const Solution s = run_mssor(p, acceleration, omega, 0.5);
      ASSERT_EQ(s.status, Status::converged) << int(acceleration) << " " << omega;
      EXPECT_LE(difference(s.u, direct.u), 1e-8);
      EXPECT_LE(difference(s.lambda, direct.lambda), 1e-8);
      EXPECT_LE(s.force_residual, 1e-11);
      EXPECT_LE(s.constraint_residual, 1e-11);
      EXPECT_EQ(s.u(0), 0.25);
    }
}

TEST(Mssor, ScalesDoNotChangeTheStepsOrTheAnswer) {
  SaddlePointSystem p = two_long_chains();
  const Solution a = run_mssor(p, Acceleration::krylov, 1.3, 0.7);
  p.K *= 0x1p37;  // powers of two: the same round-off
  p.f *= 0x1p37;
  p.B = SparseMatrix(0x1p-10 * p.B);
  p.g *= 0x1p-10;
  p.row_scale *= 0x1p-10;
  p.stiffness_scale = 0x1p37;
  const Solution b = run_mssor(p, Acceleration::krylov, 1.3, 0.7);
  EXPECT_EQ(a.iteration->steps, b.iteration->steps);
  EXPECT_LE(difference(a.u, b.u), 1e-14);
  EXPECT_LE(difference(a.lambda, VecX(b.lambda * 0x1p-47)), 1e-14);
}

TEST(Mssor, TheStationaryMethodConvergesUpToTheLimitOfTau) {
  const SaddlePointSystem p = two_long_chains();
  const SweepSystem s = sweep_system(p);
  for (const double omega : {0.5, 1.0, 1.3, 1.7}) {
    const double limit = tau_limit(s, omega);
    EXPECT_LT(spectral_radius(s, omega, 0.05 * limit), 1) << omega;
    EXPECT_LT(spectral_radius(s, omega, 0.6 * limit), 1) << omega;
    EXPECT_LT(spectral_radius(s, omega, 0.999 * limit), 1) << omega;
    EXPECT_GT(spectral_radius(s, omega, 1.001 * limit), 1) << omega;
    // between 4/3 and 2 over the largest eigenvalue of S^-1 B Q^-1 B^T
    const MatX H = MatX(s.B) * inverse_Q(s, omega) * MatX(s.B).transpose();
    const double eta = eigenvalues(inverse_of(dense_S(s)) * H).cwiseAbs().maxCoeff();
    EXPECT_GE(limit * eta, 4.0 / 3 * (1 - 1e-9)) << omega;
    EXPECT_LE(limit * eta, 2 * (1 + 1e-9)) << omega;
  }
}

TEST(Mssor, DivergenceIsSaidWithTheLimit) {
  const SaddlePointSystem p = two_long_chains();
  const double limit = tau_limit(sweep_system(p), 1.3);
  const Solution s = run_mssor(p, Acceleration::none, 1.3, 1.2 * limit);
  EXPECT_EQ(s.status, Status::diverged);
  EXPECT_GT(s.iteration->convergence_rate, 1);
  EXPECT_EQ(s.iteration->figures.back(), std::pair(std::string("tau_limit"), limit));
  EXPECT_EQ(run_mssor(p, Acceleration::krylov, 1.3, 1.2 * limit).status, Status::converged);
  EXPECT_EQ(run_mssor(p, Acceleration::minres, 1.3, 1.2 * limit).status, Status::converged);
}

TEST(Mssor, TheConvergenceRateIsTheSpectralRadius) {
  const SaddlePointSystem p = two_long_chains();
  const Solution s = run_mssor(p, Acceleration::none, 1.3, 0.5);
  EXPECT_NEAR(s.iteration->convergence_rate, spectral_radius(sweep_system(p), 1.3, 0.5), 1e-4);
}

TEST(Mssor, SymmetricQmrNeedsAboutTheStepsOfGmres) {
  const SaddlePointSystem p = two_long_chains(40, 15);
  const SweepSystem s = sweep_system(p);
  SweepPreconditioner M{s, 1.3, 0.7};
  const auto correction = [&](const VecX& x) -> VecX {
    VecX r(x.size()), z(x.size());
    multiply(s, x, r);
    M.solve(s.rhs - r, z);
    return z;
  };
  const auto measure = [&](const VecX& x, const VecX&) -> Residuals {
    VecX r(x.size());
    multiply(s, x, r);
    const double size = largest_entry(VecX(s.rhs - r)) / largest_entry(s.rhs);
    return {size, size};
  };
  const RelaxationResult gmres =
      relax(correction, measure, VecX::Zero(s.rhs.size()), {Acceleration::krylov, 1, 1e-9, 400});
  ASSERT_EQ(gmres.status, Status::converged);
  const Solution qmr = run_mssor(p, Acceleration::krylov, 1.3, 0.7, 1e-9);
  ASSERT_EQ(qmr.status, Status::converged);
  EXPECT_LE(qmr.iteration->steps, 1.5 * double(gmres.history.size()));
}

TEST(Mssor, ToldWhereThereIsNoSolution) {
  SaddlePointSystem p = two_long_chains();
  SparseMatrix doubled(6, p.B.cols());
  Triplets entries;
  for (int j = 0; j < p.B.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(p.B, j); it; ++it) {
      entries.emplace_back(it.row(), j, it.value());
      if (it.row() == 2) entries.emplace_back(5, j, 3 * it.value());
    }
  doubled.setFromTriplets(entries.begin(), entries.end());
  p.B = doubled;
  p.g = VecX::Zero(6);
  p.row_scale = VecX::Ones(6);
  const Solution dependent = run_mssor(p, Acceleration::krylov, 1.3, 0.7);
  EXPECT_EQ(dependent.status, Status::dependent_row);
  EXPECT_EQ(dependent.failed_at, 5);

  p = two_long_chains();
  p.K.coeffRef(7, 7) = 0;
  const Solution zero = run_mssor(p, Acceleration::krylov, 1.3, 0.7);
  EXPECT_EQ(zero.status, Status::not_positive_definite);
  EXPECT_EQ(zero.failed_at, 7);
}

TEST(Mssor, AUnilateralRowInTensionIsRefused) {
  SaddlePointSystem p = two_long_chains();
  p.unilateral.assign(5, 1);  // random loads: some row is in tension
  EXPECT_GT(solve_directly(grounded(two_long_chains())).lambda.maxCoeff(), 0);
  EXPECT_EQ(run_mssor(p, Acceleration::krylov, 1.3, 0.7).status, Status::in_tension);
}

TEST(Mssor, StopsAtTheLimitOfSteps) {
  const SaddlePointSystem p = two_long_chains();
  for (const Acceleration acceleration : {Acceleration::none, Acceleration::krylov, Acceleration::minres}) {
    const Solution s = solve_by_mssor(p, {1.3, 0.5, acceleration, 1e-11, 7});
    EXPECT_EQ(s.status, Status::not_converged);
    EXPECT_EQ(s.iteration->steps, 7);
    EXPECT_EQ(s.iteration->history.size(), 8U);
  }
}

TEST(Mssor, ATolerancePastRoundOffEnds) {
  const Solution s = solve_by_mssor(two_long_chains(), {1.3, 0.5, Acceleration::krylov, 1e-20, 3000});
  EXPECT_EQ(s.status, Status::not_converged);
  EXPECT_LE(s.force_residual, 1e-13);
}

TEST(BandOrder, NumbersAShuffledChainAlongItself) {
  const std::vector<int> along{4, 0, 6, 2, 5, 1, 3};
  Triplets entries;
  for (int i = 0; i < 7; ++i) entries.emplace_back(i, i, 2);
  for (std::size_t k = 0; k + 1 < along.size(); ++k)
    entries.emplace_back(std::max(along[k], along[k + 1]), std::min(along[k], along[k + 1]), -1);
  SparseMatrix lower(7, 7);
  lower.setFromTriplets(entries.begin(), entries.end());
  const std::vector<int> order = band_order(lower);
  const std::vector<int> back(along.rbegin(), along.rend());
  EXPECT_TRUE(order == along || order == back);
}

TEST(Mssor, WhatIsNotFiniteDivergesAndNeverConverges) {
  for (const Acceleration acceleration : {Acceleration::none, Acceleration::krylov, Acceleration::minres}) {
    for (const double bad : {std::nan(""), HUGE_VAL, 1e300}) {  // of the last the squares overflow
      SaddlePointSystem p = two_long_chains();
      p.f(9) = bad;
      const Solution s = solve_by_mssor(p, {.acceleration = acceleration});
      EXPECT_EQ(s.status, Status::diverged) << bad;
      EXPECT_FALSE(s.iteration->history.empty());
    }
    const SaddlePointSystem p = two_long_chains();
    const Solution s = solve_by_mssor(p, {.tau = 1e300, .acceleration = acceleration});
    if (s.status == Status::converged) EXPECT_LE(s.force_residual, 1e-10);
    EXPECT_FALSE(s.iteration->history.empty());
  }
}

TEST(Mssor, NoLoadIsNoDisplacement) {
  for (const Acceleration acceleration : {Acceleration::none, Acceleration::krylov, Acceleration::minres}) {
    SaddlePointSystem p = two_long_chains();
    p.f.setZero();
    p.g.setZero();
    p.constraints.value.setZero();
    const Solution s = solve_by_mssor(p, {.acceleration = acceleration});
    EXPECT_EQ(s.status, Status::converged);
    EXPECT_EQ(largest_entry(s.u), 0);
  }
}

}  // namespace
}  // namespace mortise
