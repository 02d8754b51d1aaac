// The complementarity problem of unilateral rows, against a search through all active sets (exact).
#include "solve/active_set.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "base/dense.hpp"
#include "solve/coarse_rows.hpp"
#include "solve/dense_rows.hpp"

namespace mortise {
namespace {

struct Problem {
  MatX compliance;  // full
  VecX rhs, scale;
  std::vector<char> unilateral;
  double round_off = 0;
  Eigen::Index m() const { return scale.size(); }
  ComplementarityProblem problem() const {
    return {.compliance = compliance, .scale = scale, .unilateral = unilateral, .round_off = round_off};
  }
  ActiveSetResult solve(const std::vector<char>& start = {}, const ActiveSetOptions& options = {}) const {
    return find_active_set(problem(), rhs, start, options);
  }
};

// C = V V^T with rows V of `rank` columns, s free motions H.
Problem random_problem(std::mt19937& random, Eigen::Index m, Eigen::Index springs, bool some_bilateral) {
  std::normal_distribution<double> value;
  const auto draw = [&] { return value(random); };
  Problem p;
  const MatX V = MatX::NullaryExpr(m, m + 1, draw);
  p.compliance = MatX::Zero(m + springs, m + springs);
  p.compliance.topLeftCorner(m, m) = V * V.transpose();
  const MatX H = MatX::NullaryExpr(springs, m, draw);
  p.compliance.bottomLeftCorner(springs, m) = H;
  p.compliance.topRightCorner(m, springs) = H.transpose();
  p.compliance.bottomRightCorner(springs, springs).setIdentity();
  p.rhs = VecX::NullaryExpr(m + springs, draw);
  p.scale = VecX::NullaryExpr(m, [&] { return 0.1 + std::abs(value(random)); });
  p.unilateral.assign(m, 1);
  if (some_bilateral)
    for (std::size_t a = 0; a < std::size_t(m); a += 3) p.unilateral[a] = 0;
  return p;
}

// What is open of each row.
VecX gaps(const Problem& p, const VecX& x) { return p.rhs.head(p.m()) - p.compliance.topRows(p.m()) * x; }

// (lambda, mu) of the only feasible active set, by trying all; nothing if none is.
std::optional<VecX> search(const Problem& p) {
  const Eigen::Index m = p.m(), springs = p.rhs.size() - m;
  for (int set = 0; set < 1 << m; ++set) {
    bool allowed = true;
    std::vector<Eigen::Index> rows;
    for (int a = 0; a < m; ++a) {
      allowed = allowed && (p.unilateral[a] || (set >> a & 1));
      if (set >> a & 1) rows.push_back(a);
    }
    if (!allowed) continue;
    const std::size_t bars = rows.size();
    for (Eigen::Index k = 0; k < springs; ++k) rows.push_back(m + k);
    MatX A = p.compliance(rows, rows);
    A.bottomRightCorner(springs, springs).setZero();
    VecX x = VecX::Zero(m + springs);
    if (!rows.empty()) {
      const Eigen::FullPivLU<MatX> lu(A);
      if (!lu.isInvertible()) continue;
      x(rows) = lu.solve(VecX(p.rhs(rows)));
    }
    const VecX w = gaps(p, x);
    bool feasible = true;
    const double tolerance = 1e-10 * (1 + x.cwiseAbs().maxCoeff());
    for (Eigen::Index a = 0; a < m; ++a)
      if (p.unilateral[a]) feasible = feasible && x(a) <= tolerance && w(a) >= -tolerance;
    if (feasible && bars >= std::size_t(springs)) return x;
  }
  return {};
}

void expect_solution(const Problem& p, const ActiveSetResult& r, const VecX& exact) {
  ASSERT_EQ(r.status, SolveStatus::converged);
  EXPECT_LE((stacked(r.lambda, r.mu) - exact).cwiseAbs().maxCoeff(), 1e-8 * (1 + exact.cwiseAbs().maxCoeff()));
  EXPECT_LE(r.lambda.cwiseProduct(gaps(p, stacked(r.lambda, r.mu))).cwiseAbs().maxCoeff(), 1e-8);
}

class ActiveSets : public testing::TestWithParam<std::tuple<bool, Eigen::Index>> {};

TEST_P(ActiveSets, AgreesWithASearchThroughAllSets) {
  const auto [some_bilateral, springs] = GetParam();
  std::mt19937 random(11);
  int unconstrained = 0;
  for (int run = 0; run < 300; ++run) {
    const Problem p = random_problem(random, 2 + run % 9, springs, some_bilateral);
    if (p.m() < springs) continue;
    const auto exact = search(p);
    const ActiveSetResult r = p.solve();
    if (exact) {
      expect_solution(p, r, *exact);
    } else {
      ++unconstrained;
      EXPECT_NE(r.status, SolveStatus::converged);
    }
  }
  if (springs == 0) EXPECT_EQ(unconstrained, 0);  // a positive definite problem always has a solution
  if (springs > 0 && !some_bilateral) EXPECT_GT(unconstrained, 0);
}

INSTANTIATE_TEST_SUITE_P(Random, ActiveSets, testing::Combine(testing::Bool(), testing::Values(0, 1, 2)));

Problem held_problem(const MatX& C, const VecX& rhs) {
  const Eigen::Index m = C.rows();
  return {C, rhs, VecX::Ones(m), std::vector<char>(m, 1)};
}

TEST(ActiveSet, BreaksTheCycleOfThePlainMethod) {
  // The plain method goes round through four active sets here (found by search; p >= 0, C p >= -rhs).
  MatX C(3, 3);
  C << 4, 5, -5, 5, 9, -5, -5, -5, 7;
  const Problem p = held_problem(C, Eigen::Vector3d(-2, -1, 3));
  const ActiveSetResult r = p.solve();
  EXPECT_GT(r.interior_steps, 0);
  expect_solution(p, r, *search(p));
}

TEST(ActiveSet, OneSolveWhereNothingIsInTension) {
  const ActiveSetResult r = held_problem(MatX::Identity(3, 3), -VecX::Ones(3)).solve();
  EXPECT_EQ(r.status, SolveStatus::converged);
  EXPECT_EQ(r.steps.size(), 1u);
  EXPECT_EQ(r.steps[0].active, 3);
  EXPECT_EQ(r.steps[0].changed, 0);
}

TEST(ActiveSet, AStepTellsTheMostOfWhatItFoundInAnyRow) {
  const Problem open = held_problem(MatX::Identity(3, 3), Eigen::Vector3d(-3, -5, -1));
  const ActiveSetResult penetrated = open.solve({0, 0, 0});
  EXPECT_EQ(penetrated.steps[0].penetration, 5);
  EXPECT_EQ(penetrated.steps[0].tension, 0);
  EXPECT_EQ(penetrated.steps[0].changed, 3);
  const ActiveSetResult pulled = held_problem(MatX::Identity(3, 3), Eigen::Vector3d(3, 5, 1)).solve({1, 1, 1});
  EXPECT_EQ(pulled.steps[0].tension, 5);
  EXPECT_EQ(pulled.steps[0].penetration, 0);
}

// With a part of the answer known and taken off the right-hand side, the whole answer is the same: open rows carry
// nothing.
TEST(ActiveSet, WhatIsKnownOfTheMultipliersChangesNoAnswer) {
  std::mt19937 random(5);
  const Problem p = random_problem(random, 6, 0, false);
  const std::vector<char> closed{1, 0, 1, 1, 0, 1};
  const ComplementarityProblem whole = p.problem();
  const ContactRows::Answer answer = DenseRows(whole, p.rhs).solve(closed, {});
  ComplementarityProblem rest = whole;
  rest.known = VecX::LinSpaced(6, -2, 3);
  rest.displacement = 1;
  const VecX left = p.rhs - p.compliance * rest.known;
  const ContactRows::Answer corrected = DenseRows(rest, left).solve(closed, {});
  EXPECT_LT((corrected.lambda - answer.lambda).norm(), 1e-10 * answer.lambda.norm());
  EXPECT_LT((corrected.w - answer.w).norm(), 1e-10 * p.rhs.norm());
}

// Each row is one displacement.
SaddlePointSystem two_unilateral_rows() {
  SaddlePointSystem s;
  s.B = MatX(MatX::Identity(2, 2)).sparseView();
  s.g = VecX::Zero(2);
  s.row_scale = VecX::Ones(2);
  s.unilateral = {1, 1};
  return s;
}

TEST(ActiveSet, AnOpenRowThatPenetratesIsSeen) {
  SaddlePointSystem s = two_unilateral_rows();
  Solution solution;
  solution.lambda = VecX::Zero(2);
  const auto seen = [&](double second, std::vector<char> active) {
    solution.u = VecX{{1, second}};
    solution.active = std::move(active);
    return is_infeasible(s, solution, 0);
  };
  EXPECT_TRUE(seen(-1e-6, {1, 0}));
  EXPECT_FALSE(seen(-1e-6, {1, 1}));
  EXPECT_FALSE(seen(-1e-13, {1, 0}));
  EXPECT_FALSE(seen(1e-6, {1, 0}));
  s.unilateral = {1, 0};
  EXPECT_FALSE(seen(-1e-6, {1, 0}));
}

TEST(ActiveSet, AClosedRowInTensionIsSeen) {
  SaddlePointSystem s = two_unilateral_rows();
  Solution solution;
  solution.u = VecX::Zero(2);
  const auto seen = [&](double second, std::vector<char> active) {
    solution.lambda = VecX{{-1, second}};
    solution.active = std::move(active);
    return is_infeasible(s, solution, 1e-10);
  };
  EXPECT_TRUE(seen(1e-8, {1, 1}));
  EXPECT_FALSE(seen(1e-12, {1, 1}));
  EXPECT_FALSE(seen(-1e-8, {1, 1}));
  s.unilateral = {1, 0};
  EXPECT_FALSE(seen(1e-8, {1, 1}));
}

TEST(ActiveSet, RoundOffChangesNoRow) {
  // lambda = 0 (to 1e-14 of the largest) on row 1, and w = 0 on row 2 although it is open at the start.
  for (const double tiny : {1e-14, -1e-14}) {
    const Problem p = held_problem(MatX::Identity(3, 3), Eigen::Vector3d(-1, tiny, tiny));
    const ActiveSetResult r = p.solve({1, 1, 0});
    EXPECT_EQ(r.status, SolveStatus::converged);
    EXPECT_EQ(r.steps.size(), 1u);
  }
}

TEST(ActiveSet, NothingTouches) {
  const ActiveSetResult r = held_problem(MatX::Identity(4, 4), VecX::Ones(4)).solve();
  EXPECT_EQ(r.status, SolveStatus::converged);
  EXPECT_EQ(r.lambda.norm(), 0);
  EXPECT_EQ(r.steps.back().active, 0);
}

TEST(ActiveSet, ABodyPushedOntoContactFromAnEmptySetFindsIt) {
  std::mt19937 random(3);
  Problem p = random_problem(random, 6, 1, false);
  p.compliance.row(6).head(6).setConstant(-1);  // the motion closes every row
  p.compliance.col(6).head(6).setConstant(-1);
  p.rhs(6) = 2;  // and the load drives it
  expect_solution(p, p.solve(std::vector<char>(6, 0)), *search(p));
}

TEST(ActiveSet, ABodyPulledAwayIsUnheldAndDriven) {
  std::mt19937 random(3);
  Problem p = random_problem(random, 6, 1, false);
  p.compliance.row(6).head(6).setConstant(-1);
  p.compliance.col(6).head(6).setConstant(-1);
  p.rhs(6) = -2;
  const ActiveSetResult r = p.solve();
  EXPECT_EQ(r.status, SolveStatus::unconstrained);
  EXPECT_LT(r.driven_mode(0), 0);
}

TEST(ActiveSet, ABodyThatNothingDrives) {
  std::mt19937 random(3);
  Problem p = random_problem(random, 4, 1, false);
  p.compliance.row(4).head(4).setConstant(-1);
  p.compliance.col(4).head(4).setConstant(-1);
  p.rhs.setOnes();
  p.rhs(4) = 0;
  // From the start nothing holds it, and no load says where it goes: it stays.
  const ActiveSetResult r = p.solve(std::vector<char>(4, 0));
  ASSERT_EQ(r.status, SolveStatus::converged);
  EXPECT_EQ(r.system->rigid_modes().cols(), 1);
  EXPECT_EQ(largest_entry(stacked(r.lambda, r.mu)), 0);
  // From closed rows it ends where it just touches.
  const ActiveSetResult touching = p.solve();
  ASSERT_EQ(touching.status, SolveStatus::converged);
  EXPECT_LE(touching.lambda.cwiseAbs().maxCoeff(), 1e-10);
}

// Rollers of radius 1 between two plates, upon a row each side at angles of `spread`: the lowest plate stands, the
// uppermost one may move up and down; each roller may move both ways. A load presses the plate on.
Problem rollers(int count, int rows_a_side, double spread) {
  const Eigen::Index m = 2 * count * rows_a_side, springs = 2 * count + 1;
  Problem p;
  p.compliance = MatX::Zero(m + springs, m + springs);
  p.rhs = VecX::Zero(m + springs);
  p.scale = VecX::Ones(m);
  p.unilateral.assign(m, 1);
  std::vector<Eigen::Vector3d> places;  // roller, side, angle
  for (int k = 0; k < count; ++k)
    for (const int side : {-1, 1})
      for (int i = 0; i < rows_a_side; ++i) places.emplace_back(k, side, spread * (2 * (i + 0.3) / rows_a_side - 1));
  for (Eigen::Index a = 0; a < m; ++a) {
    const double roller = places[a](0), side = places[a](1), angle = places[a](2);
    for (Eigen::Index b = 0; b < m; ++b)
      if (places[b](0) == roller && places[b](1) == side)
        p.compliance(a, b) = 1e-3 * std::exp(-10 * std::abs(places[b](2) - angle));
    const Eigen::Index motion = m + 2 * Eigen::Index(roller);  // opens (below) or closes (above) the row
    p.compliance(motion, a) = side * std::sin(angle);
    p.compliance(motion + 1, a) = side * std::cos(angle);
    if (side > 0) p.compliance(m + springs - 1, a) = -std::cos(angle);
    p.rhs(a) = 1 - std::cos(angle) + 1e-4 * roller * (side > 0);
  }
  p.compliance.topRightCorner(m, springs) = p.compliance.bottomLeftCorner(springs, m).transpose();
  p.rhs(m + springs - 1) = 1;
  return p;
}

TEST(ActiveSet, RollersThatFewRowsHoldDoNotTravel) {
  for (const int count : {1, 2, 4, 8})
    for (const int rows : {5, 9, 17}) {
      SCOPED_TRACE(std::to_string(count) + " rollers, " + std::to_string(rows) + " rows");
      const Problem p = rollers(count, rows, 0.3);
      const ActiveSetResult r = p.solve();
      ASSERT_EQ(r.status, SolveStatus::converged);
      const VecX x = stacked(r.lambda, r.mu), w = gaps(p, x);
      EXPECT_LE(r.lambda.maxCoeff(), 1e-9);
      EXPECT_GE(w.minCoeff(), -1e-9);
      EXPECT_LE(r.lambda.cwiseProduct(w).cwiseAbs().maxCoeff(), 1e-9);
      const VecX balance = p.compliance.bottomLeftCorner(r.mu.size(), p.m()) * r.lambda - p.rhs.tail(r.mu.size());
      EXPECT_LE(largest_entry(balance), 1e-9);
      std::printf("%d rollers, %d rows a side: %zu steps\n", count, rows, r.steps.size());
    }
}

TEST(ActiveSet, NamesADependentRow) {
  MatX C = MatX::Identity(3, 3);
  C(2, 0) = C(0, 2) = 1;
  const ActiveSetResult r = held_problem(C, -VecX::Ones(3)).solve();
  EXPECT_EQ(r.status, SolveStatus::dependent_row);
  EXPECT_EQ(r.dependent_row, 2);
}

// A beam under a line of rows: the inverse of a bending stiffness on an elastic foundation, pressed, and pulled at one
// end. It peels off its support from there.
Problem peeling(Eigen::Index m) {
  const double h = 1.0 / double(m);
  MatX D = MatX::Zero(m, m);
  for (Eigen::Index a = 1; a + 1 < m; ++a) D.row(a).segment(a - 1, 3) = Eigen::RowVector3d(1, -2, 1) / (h * h);
  MatX K = 1e-6 * h * D.transpose() * D + 1e-3 * h * MatX::Identity(m, m);
  const MatX foundation = 1e-3 / h * MatX::Identity(m, m);
  const MatX beam = inverse_of(K);
  VecX load = -VecX::Constant(m, h);
  load(m - 1) += 0.1;
  Problem p = held_problem(beam + foundation, beam * load);
  return p;
}

TEST(ActiveSet, TheNumberOfStepsDoesNotGrowWithTheRows) {
  for (const Eigen::Index m : {50, 100, 200, 400}) {
    const Problem p = peeling(m);
    const ActiveSetResult r = p.solve();
    ASSERT_EQ(r.status, SolveStatus::converged);
    EXPECT_LE(r.steps.size(), 6u) << m;
    EXPECT_GT(r.steps.back().active, 0);
    EXPECT_LT(r.steps.back().active, m);
    ActiveSetOptions plain;
    plain.start_steps = 1000;
    const ActiveSetResult slow = p.solve(std::vector<char>(m, 1), plain);
    EXPECT_EQ(slow.active, r.active);
    std::printf("%3d rows: %zu steps, plain %zu\n", int(m), r.steps.size(), slow.steps.size());
  }
}

TEST(ActiveSet, ItsOwnAnswerIsAStartThatTakesOneStep) {
  const Problem p = peeling(100);
  const ActiveSetResult r = p.solve();
  const ActiveSetResult again = p.solve(r.active);
  EXPECT_EQ(again.steps.size(), 1u);
  EXPECT_EQ(again.active, r.active);
}

TEST(CoarseRows, JoinNeighboursThatMayBothOpen) {
  std::mt19937 random(5);
  Problem p = random_problem(random, 7, 1, false);
  p.unilateral = {1, 1, 0, 1, 1, 1, 0};
  const CoarseRows c = join_rows(p.problem(), p.rhs);
  EXPECT_EQ(c.group, (std::vector<int>{0, 0, 1, 2, 2, 3, 4}));
  EXPECT_EQ(c.problem.unilateral, (std::vector<char>{1, 0, 1, 1, 0}));
  EXPECT_NEAR(c.problem.scale.sum(), p.scale.sum(), 1e-12);
  // One stress on all rows is one stress on all joined rows: the same gaps, added up.
  VecX fine(8), coarse(6);
  fine << p.scale, 0.5;
  coarse << c.problem.scale, 0.5;
  const VecX w = gaps(p, fine), v = c.rhs.head(5) - (c.problem.compliance * coarse).head(5);
  EXPECT_NEAR(v.dot(c.problem.scale), w.dot(p.scale), 1e-12);
}

TEST(ActiveSet, WhatIsNotFiniteDoesNotConverge) {
  for (const double bad : {std::nan(""), HUGE_VAL})
    for (const Eigen::Index at : {0, 3, 6}) {  // a gap, another one, the load's work on the motion
      std::mt19937 random(5);
      Problem p = random_problem(random, 6, 1, false);
      p.rhs(at) = bad;
      const ActiveSetResult r = p.solve();
      EXPECT_NE(r.status, SolveStatus::converged) << bad << " at " << at;
    }
}

}  // namespace
}  // namespace mortise
