// Contact solves always end: random problems end as a solution that satisfies its conditions, or as motions that prove
// that there is none.
#include "solve/interior_point.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "solve/active_set.hpp"
#include "solve/dense_rows.hpp"
#include "solve/nonnegative_fit.hpp"

namespace mortise {
namespace {

struct ConvexProblem {
  ComplementarityProblem rows;
  VecX rhs;
  Eigen::Index m() const { return rows.scale.size(); }
  Eigen::Index motions() const { return rhs.size() - m(); }
  MatX C() const { return rows.compliance.topLeftCorner(m(), m()); }
  MatX H() const { return rows.compliance.bottomLeftCorner(motions(), m()).transpose(); }
};

ConvexProblem problem(const MatX& C, const MatX& H, const VecX& r, const VecX& h) {
  const Eigen::Index m = C.rows(), s = H.cols();
  ConvexProblem p{
      {.compliance = MatX::Zero(m + s, m + s), .scale = VecX::Ones(m), .unilateral = std::vector<char>(m, 1)},
      stacked(r, h)};
  p.rows.compliance.topLeftCorner(m, m) = C;
  p.rows.compliance.topRightCorner(m, s) = H;
  p.rows.compliance.bottomLeftCorner(s, m) = H.transpose();
  return p;
}

enum class Kind { any, carried, degenerate, weak, apart, pulled };

// `carried`: the load is what some pressures do. `degenerate`: and rows in threes are nearly one, some of them just
// touch. `weak`: and motions open rows by 1 to 1e-4. `apart`: and open rows are 1 to 1e6 away. `pulled`: the load on
// one motion goes away from all rows.
ConvexProblem random_convex(std::mt19937& random, Kind kind, Eigen::Index m, Eigen::Index s) {
  std::normal_distribution<double> value;
  const auto draw = [&] { return value(random); };
  const MatX V = MatX::NullaryExpr(m, m, draw);
  MatX C = V * V.transpose() / double(m) + 1e-3 * MatX::Identity(m, m), H = MatX::NullaryExpr(m, s, draw);
  VecX r = VecX::NullaryExpr(m, draw), h = VecX::NullaryExpr(s, draw);
  if (kind == Kind::degenerate)
    for (Eigen::Index a = 0; a + 2 < m; a += 3)
      for (const Eigen::Index b : {a + 1, a + 2}) H.row(b) = H.row(a) + 1e-9 * H.row(b);
  if (kind == Kind::weak)
    for (Eigen::Index k = 0; k < s; ++k)
      H.col(k) *= std::pow(10.0, -4.0 * double(k) / double(std::max<Eigen::Index>(s - 1, 1)));
  if (kind == Kind::pulled) H.col(0) = H.col(0).cwiseAbs();
  VecX lambda = VecX::NullaryExpr(m, [&] { return std::min(draw(), 0.0); }), mu = VecX::NullaryExpr(s, draw);
  if (kind == Kind::degenerate) {
    for (Eigen::Index a = 0; a < m; a += 4) lambda(a) = 0;
    r = C * lambda + H * mu;  // all rows touch
    for (Eigen::Index a = 0; a < m; ++a)
      if (lambda(a) == 0 && a % 3 == 0) r(a) += 1;
  }
  if (kind == Kind::apart) {
    r = C * lambda + H * mu;
    for (Eigen::Index a = 0; a < m; ++a)
      if (lambda(a) == 0) r(a) += std::pow(10.0, 6 * std::min(1.0, std::abs(draw())));
  }
  if (kind != Kind::any) h = H.transpose() * lambda;
  if (kind == Kind::pulled) h(0) = 1;
  return problem(C, H, r, h);
}

void expect_optimal(const ConvexProblem& p, const ActiveSetResult& r) {
  const VecX w = p.rhs.head(p.m()) - p.C() * r.lambda - p.H() * r.mu;
  const double pressure = largest_entry(r.lambda),
               gap = std::max(largest_entry(p.rhs.head(p.m())), largest_entry(p.C() * r.lambda.cwiseAbs()));
  for (Eigen::Index a = 0; a < p.m(); ++a) {
    EXPECT_LE(r.lambda(a), 1e-9 * pressure);
    EXPECT_GE(w(a), -1e-9 * gap);
    EXPECT_LE(std::abs(w(a) * r.lambda(a)), 1e-9 * gap * pressure);
  }
  if (p.motions() == 0) return;
  const VecX left = p.rhs.tail(p.motions()) - p.H().transpose() * r.lambda;
  const VecX terms = p.rhs.tail(p.motions()).cwiseAbs() + p.H().cwiseAbs().transpose() * r.lambda.cwiseAbs();
  // Where no force is needed lambda is round-off of what the gaps would press.
  const double none = 1e-14 * gap * p.H().cwiseAbs().maxCoeff() / p.C().diagonal().minCoeff();
  EXPECT_LE(largest_entry(left), 1e-9 * largest_entry(terms) + none);
}

// Farkas: opens no row to below zero, and the load works on it.
void expect_proof(const ConvexProblem& p, const VecX& motion) {
  const VecX opening = p.H() * motion;
  EXPECT_GE(opening.minCoeff(), -1e-8 * largest_entry(opening));
  EXPECT_GT(motion.dot(p.rhs.tail(p.motions())), 1e-8 * motion.cwiseAbs().dot(p.rhs.tail(p.motions()).cwiseAbs()));
}

class RandomContact : public testing::TestWithParam<Kind> {};

TEST_P(RandomContact, EndsAsASolutionOrAsAProofThatThereIsNone) {
  std::mt19937 random(17);
  int runs = 0, none = 0, interior = 0, most = 0;
  for (int run = 0; run < 300; ++run) {
    SCOPED_TRACE(run);
    const Eigen::Index m = 4 + run % 50, s = run % 7 * m / 10;
    if (GetParam() == Kind::pulled && s == 0) continue;
    ++runs;
    const ConvexProblem p = random_convex(random, GetParam(), m, s);
    const ActiveSetResult r = find_active_set(p.rows, p.rhs);
    interior += r.interior_steps > 0;
    most = std::max(most, r.interior_steps + int(r.steps.size()));
    if (r.status == SolveStatus::converged) {
      expect_optimal(p, r);
    } else {
      ASSERT_EQ(r.status, SolveStatus::unconstrained) << r.interior_steps << " interior steps, " << r.steps.size()
                                                      << " of the set, " << r.infeasible.size() << " infeasible rows";
      expect_proof(p, r.driven_mode);
      ++none;
    }
  }
  std::printf("%d of %d without a solution, %d by interior points, %d factorisations at most\n", none, runs, interior,
              most);
  switch (GetParam()) {
    case Kind::any:
      EXPECT_GT(none, 0);
      break;
    case Kind::pulled:
      EXPECT_EQ(none, runs);
      break;
    default:
      EXPECT_EQ(none, 0);
  }
  EXPECT_LE(most, 60);
}

INSTANTIATE_TEST_SUITE_P(Kinds, RandomContact,
                         testing::Values(Kind::any, Kind::carried, Kind::degenerate, Kind::weak, Kind::apart,
                                         Kind::pulled));

class InteriorPointAlone : public testing::TestWithParam<Kind> {};

TEST_P(InteriorPointAlone, FindsTheRowsOfRandomProblems) {
  std::mt19937 random(5);
  for (int run = 0; run < 100; ++run) {
    SCOPED_TRACE(run);
    const Eigen::Index m = 4 + run, s = run % 5 * m / 20;
    const ConvexProblem p = random_convex(random, GetParam(), m, s);
    DenseRows rows(p.rows, p.rhs);
    const InteriorPoint point = find_interior_point(rows);
    ASSERT_TRUE(point.converged);
    EXPECT_LE(point.steps, GetParam() == Kind::apart ? 34 : 25);  // farther from the start
    EXPECT_LE(point.at.lambda.maxCoeff(), 0);
    const VecX w = rows.gaps(point.at);
    EXPECT_GE(w.minCoeff(), -1e-9);
    const double pressure = largest_entry(point.at.lambda.cwiseProduct(rows.diagonal().cwiseSqrt()));
    EXPECT_LE(w.cwiseProduct(point.at.lambda).cwiseAbs().maxCoeff(),  // 1e-10: what is left of the gaps
              (1e-10 + 1e-12 * double(m)) * pressure * pressure);
    EXPECT_EQ(find_active_set(p.rows, p.rhs).active, point.closed);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, InteriorPointAlone, testing::Values(Kind::carried, Kind::apart));

// Ten pipes in a rack: lambda w falls to 0.6 of itself for many steps, and yet to zero.
TEST(Halving, GoesOnAsLongAsAMeasureFalls) {
  for (const double factor : {0.1, 0.6, 0.86, 0.88, 0.99, 1.0, 2.0}) {
    Halving product(1, 5);
    double now = 1;
    int steps = 0;
    do now *= factor;
    while (product.goes_on(now) && ++steps < 100);
    EXPECT_EQ(steps, factor < 0.87 ? 100 : 4) << factor;  // 0.87^5 = 1/2
  }
}

TEST(InteriorPoint, EndsWhereNothingIsPressed) {
  std::mt19937 random(6);
  for (int run = 0; run < 100; ++run) {
    SCOPED_TRACE(run);
    ConvexProblem p = random_convex(random, Kind::carried, 4 + run, 2);
    p.rhs.head(p.m()) = p.rhs.head(p.m()).cwiseAbs();
    p.rhs.tail(2).setZero();
    DenseRows rows(p.rows, p.rhs);
    const InteriorPoint point = find_interior_point(rows);
    ASSERT_TRUE(point.converged);
    EXPECT_LE(point.steps, 25);
    EXPECT_EQ(std::ranges::count(point.closed, 1), 0);
  }
}

// Rows that give way far more than the bodies do are factorised as if each were alone; some motions are held by them
// alone. Pressures on a body that bends move all its rows, the soft ones by more than their gaps.
TEST(InteriorPoint, SoftRowsAreMovedByPressuresElsewhere) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> power(0, 6);
  for (int run = 0; run < 100; ++run) {
    SCOPED_TRACE(run);
    const Eigen::Index m = 10 + run, s = 3, soft = m / 2;
    ConvexProblem p = random_convex(random, Kind::any, m, s);
    p.rows.compliance.row(m + s - 1).tail(m + s - soft).setZero();
    p.rows.compliance.col(m + s - 1).tail(m + s - soft).setZero();
    if (run % 2) p.rows.compliance.topLeftCorner(m, m).array() += 1e3;
    DenseRows rows(p.rows, p.rhs);
    VecX give = p.C().cwiseAbs().rowwise().sum();
    for (Eigen::Index a = 0; a < m; ++a)
      give(a) *= a < soft ? 2 * far_more * std::pow(10, power(random)) : std::pow(10, -power(random));
    MatX system = p.rows.compliance;
    system.diagonal().head(m) += give;
    const VecX exact = system.partialPivLu().solve(p.rhs);
    ASSERT_TRUE(rows.soften(give));
    const auto [lambda, mu] = rows.solve_softened(p.rhs.head(m), p.rhs.tail(s));
    const VecX size = give.cwiseSqrt();
    EXPECT_LE((lambda - exact.head(m)).cwiseProduct(size).norm(), 1e-3 * exact.head(m).cwiseProduct(size).norm());
    EXPECT_LE((mu - exact.tail(s)).norm(), 1e-3 * exact.tail(s).norm());
    EXPECT_LE((p.H().transpose() * lambda - p.rhs.tail(s)).norm(), 1e-8 * p.rhs.tail(s).norm());
  }
}

// The last motion is seen by no row; what is left of its load is round-off of the pressures, not of their correction.
TEST(ActiveSet, ACorrectionStartsFromWhatIsKnown) {
  std::mt19937 random(9);
  for (int run = 0; run < 50; ++run) {
    SCOPED_TRACE(run);
    const Eigen::Index m = 10 + run, s = 3;
    ConvexProblem p = random_convex(random, Kind::carried, m, s);
    p.rows.compliance.col(m + s - 1).setZero();
    p.rows.compliance.row(m + s - 1).setZero();
    p.rhs(m + s - 1) = 0;
    const ActiveSetResult whole = find_active_set(p.rows, p.rhs);
    ASSERT_EQ(whole.status, SolveStatus::converged);
    std::vector<char> start = whole.active;
    const auto open = std::ranges::find(start, 0);
    ASSERT_NE(open, start.end());
    *open = 1;
    p.rows.known = whole.lambda;
    p.rows.known(open - start.begin()) = 1e-9;  // in tension
    p.rows.displacement = 1;
    VecX left = p.rhs - p.rows.compliance * stacked(p.rows.known, VecX::Zero(s));
    left(m + s - 1) = 1e-15;
    const ActiveSetResult found = find_active_set(p.rows, left, start);
    EXPECT_EQ(found.status, SolveStatus::converged);
    EXPECT_EQ(found.active, whole.active);
    EXPECT_LE((found.lambda - whole.lambda).norm(), 1e-9 * whole.lambda.norm());
    EXPECT_LE(found.steps.size(), 2);
  }
}

TEST(NonnegativeFit, LeavesNothingOrAProof) {
  std::mt19937 random(8);
  std::normal_distribution<double> value;
  const auto draw = [&] { return value(random); };
  int proofs = 0;
  for (int run = 0; run < 200; ++run) {
    SCOPED_TRACE(run);
    const Eigen::Index n = 1 + run % 8, m = 1 + run % 13;
    const MatX A = MatX::NullaryExpr(n, m, draw);
    const VecX b = VecX::NullaryExpr(n, draw);
    std::vector<char> free(m, 0);
    free[0] = run % 3 == 0;
    const NonnegativeFit fit = fit_nonnegative(A, b, free);
    EXPECT_LE(largest_entry(A * fit.x + fit.residual - b), 1e-12 * (1 + largest_entry(fit.x)));
    for (Eigen::Index a = 0; a < m; ++a) {
      if (!free[a]) {
        EXPECT_GE(fit.x(a), 0);
      }
    }
    const VecX along = A.transpose() * fit.residual;
    EXPECT_LE(along.maxCoeff(), 1e-10);
    if (free[0]) {
      EXPECT_NEAR(along(0), 0, 1e-10);
    }
    if (fit.residual.norm() > 1e-9) {
      EXPECT_GT(b.dot(fit.residual), 0);
      ++proofs;
    }
  }
  EXPECT_GT(proofs, 20);
  EXPECT_LT(proofs, 180);
}

}  // namespace
}  // namespace mortise
