// Relaxed and accelerated iterations on small affine problems, whose rates are known from their eigenvalues.
#include "preprint_solvers/relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mortise {
namespace {

// z(x) = b - A x with A = Q diag(eigenvalues) Q^T.
struct Affine {
  MatX A;
  VecX b, solution;

  explicit Affine(const VecX& eigenvalues) {
    const Eigen::Index n = eigenvalues.size();
    MatX Q = MatX::Identity(n, n);
    for (Eigen::Index k = 0; k + 1 < n; ++k) {  // plane rotations
      MatX R = MatX::Identity(n, n);
      const double angle = 0.7 + double(k);
      R(k, k) = R(k + 1, k + 1) = std::cos(angle);
      R(k, k + 1) = -std::sin(angle);
      R(k + 1, k) = std::sin(angle);
      Q = Q * R;
    }
    A = Q * eigenvalues.asDiagonal() * Q.transpose();
    solution = VecX::LinSpaced(n, 1, 2);
    b = A * solution;
  }
  Correction correction() const {
    return [this](const VecX& x) -> VecX { return b - A * x; };
  }
};

Residuals size_of_z(const VecX&, const VecX& z) { return {z.norm(), z.norm()}; }

RelaxationResult run(const Affine& problem, Acceleration acceleration, double beta, int most = 100) {
  return relax(problem.correction(), size_of_z, VecX::Zero(problem.b.size()),
               {.acceleration = acceleration, .beta = beta, .tolerance = 1e-10, .max_iterations = most});
}

const VecX spread = (VecX(6) << 1, 1.1, 1.5, 2, 2.7, 4).finished();

TEST(Relaxation, PlainIterationConvergesAtTheRateOfTheSpectrum) {
  const Affine problem(spread);
  for (const double beta : {0.1, 0.3, 0.4, 0.48}) {
    const RelaxationResult r = run(problem, Acceleration::none, beta, 1000);
    EXPECT_EQ(r.status, SolveStatus::converged) << beta;
    // exact: the error is multiplied by 1 - beta * eigenvalue
    EXPECT_NEAR(r.convergence_rate, std::max(std::abs(1 - beta), std::abs(1 - 4 * beta)), 5e-3) << beta;
    EXPECT_LT((r.x - problem.solution).norm(), 1e-9) << beta;
  }
}

TEST(Relaxation, DivergenceIsSaidEarly) {
  const RelaxationResult r = run(Affine(spread), Acceleration::none, 0.7);  // |1 - 0.7 * 4| = 1.8
  EXPECT_EQ(r.status, SolveStatus::diverged);
  EXPECT_LT(r.history.size(), 40U);
  EXPECT_NEAR(r.convergence_rate, 1.8, 0.02);
}

TEST(Relaxation, StopsAtTheLimit) {
  const RelaxationResult r = run(Affine(spread), Acceleration::none, 0.1, 7);
  EXPECT_EQ(r.status, SolveStatus::not_converged);
  EXPECT_EQ(r.history.size(), 7U);
}

TEST(Relaxation, KrylovNeedsOneStepADistinctEigenvalue) {
  const RelaxationResult r = run(Affine(spread), Acceleration::krylov, 1);
  EXPECT_EQ(r.status, SolveStatus::converged);
  EXPECT_LE(r.history.size(), 7U);
  EXPECT_LT((r.x - Affine(spread).solution).norm(), 1e-9);
}

TEST(Relaxation, AndersonNeedsOneStepMoreThanKrylov) {
  for (const double beta : {0.1, 1.0, 3.0}) {  // it converges also where the plain iteration would not
    const RelaxationResult r = run(Affine(spread), Acceleration::anderson, beta);
    EXPECT_EQ(r.status, SolveStatus::converged) << beta;
    EXPECT_LE(r.history.size(), 8U) << beta;
  }
}

TEST(Relaxation, AitkenIsExactInOneDimension) {
  const RelaxationResult r = run(Affine(VecX::Constant(1, 5.0)), Acceleration::aitken, 0.01);
  EXPECT_EQ(r.status, SolveStatus::converged);
  EXPECT_EQ(r.history.size(), 3U);  // start, one relaxed step, the exact one
}

TEST(Relaxation, AitkenConvergesWhereTheFixedBetaDoesNot) {
  EXPECT_EQ(run(Affine(spread), Acceleration::none, 0.7).status, SolveStatus::diverged);
  EXPECT_EQ(run(Affine(spread), Acceleration::aitken, 0.7, 200).status, SolveStatus::converged);
}

TEST(Relaxation, AtTheSolutionNothingIsDone) {
  const Affine problem(spread);
  for (const auto a : {Acceleration::none, Acceleration::aitken, Acceleration::anderson, Acceleration::krylov}) {
    const RelaxationResult r = relax(problem.correction(), size_of_z, problem.solution, {.acceleration = a});
    EXPECT_EQ(r.status, SolveStatus::converged);
    EXPECT_EQ(r.history.size(), 1U);
  }
}

TEST(Relaxation, NotANumberIsDivergence) {
  const Correction broken = [](const VecX& x) -> VecX { return VecX::Constant(x.size(), std::nan("")); };
  const RelaxationResult r = relax(broken, size_of_z, VecX::Zero(2), {.acceleration = Acceleration::aitken});
  EXPECT_EQ(r.status, SolveStatus::diverged);
}

TEST(Relaxation, WhatIsNotFiniteDivergesAtOnce) {
  const Measure nothing_left = [](const VecX&, const VecX&) { return Residuals{0, 0}; };
  for (const Acceleration acceleration :
       {Acceleration::none, Acceleration::aitken, Acceleration::anderson, Acceleration::krylov})
    for (const double bad : {std::nan(""), HUGE_VAL}) {
      const Correction correction = [bad](const VecX& x) -> VecX { return VecX::Constant(x.size(), bad); };
      const RelaxationResult r = relax(correction, nothing_left, VecX::Zero(3), {.acceleration = acceleration});
      EXPECT_EQ(r.status, SolveStatus::diverged);
      EXPECT_EQ(r.history.size(), 1U);
    }
}

TEST(Relaxation, AResidualThatIsNotANumberDoesNotConverge) {
  const Affine problem(spread);
  for (const bool kinematic : {true, false}) {
    const Measure measure = [kinematic](const VecX&, const VecX&) {
      return Residuals{kinematic ? std::nan("") : 0, kinematic ? 0 : std::nan("")};
    };
    const RelaxationResult r =
        relax(problem.correction(), measure, VecX::Zero(problem.b.size()), {.beta = 0.4, .max_iterations = 30});
    EXPECT_NE(r.status, SolveStatus::converged);
  }
}

}  // namespace
}  // namespace mortise
