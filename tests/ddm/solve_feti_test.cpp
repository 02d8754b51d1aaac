// The dual method against the direct one on systems of many small bodies.
#include "ddm/solve_feti.hpp"

#include <gtest/gtest.h>

#include <random>

#include "ddm/dual_system.hpp"
#include "solve/contact_factor.hpp"
#include "solve/direct.hpp"

namespace mortise {
namespace {

constexpr int nodes = 6;  // of a body: a closed ring of springs in both directions

struct Towers {
  double contrast = 1;      // of the bodies' stiffnesses
  bool unilateral = false;  // rows may open
  double lift = 0;          // on the uppermost body, against the load
};

// Bodies upon one another, each of which may move by (1, 0) and (0, 1) but the lowest, which is held; four rows between
// each two bodies, two a direction.
SaddlePointSystem tower(int bodies, const Towers& t = {}) {
  SaddlePointSystem s;
  Triplets K, B;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> exponent(0, 1);
  const int n = 2 * nodes * bodies;
  for (int b = 0; b < bodies; ++b) {
    const double k = std::pow(t.contrast, exponent(random));
    for (int i = 0; i < nodes; ++i)
      for (int c = 0; c < 2; ++c) {
        const int one = 2 * (nodes * b + i) + c, other = 2 * (nodes * b + (i + 1) % nodes) + c;
        K.emplace_back(one, one, k * (1 + 0.1 * i));
        K.emplace_back(other, other, k * (1 + 0.1 * i));
        K.emplace_back(std::max(one, other), std::min(one, other), -k * (1 + 0.1 * i));
      }
    if (b == 0) continue;
    s.grounded.push_back(2 * nodes * b);
    s.grounded.push_back(2 * nodes * b + 1);
    for (int c = 0; c < 2; ++c)
      for (int i = 0; i < 2; ++i) {
        const int row = 4 * (b - 1) + 2 * i + c;
        B.emplace_back(row, 2 * (nodes * b + i) + c, 1);
        B.emplace_back(row, 2 * (nodes * (b - 1) + 3 + i) + c, -1);
      }
  }
  s.K.resize(n, n);
  s.K.setFromTriplets(K.begin(), K.end());
  s.B.resize(4 * (bodies - 1), n);
  s.B.setFromTriplets(B.begin(), B.end());
  s.f = VecX::LinSpaced(n, -1, -2);
  for (int i = 1; i < n; i += 2) s.f(i) -= 1;
  s.f(n - 1) += t.lift;
  s.g = VecX::LinSpaced(s.B.rows(), 0.1, -0.1);
  s.row_scale = VecX::LinSpaced(s.B.rows(), 1, 2);
  s.constraints = {std::vector<char>(n, 0), VecX::Zero(n)};
  s.constraints.fixed[0] = s.constraints.fixed[1] = s.constraints.fixed[7] = 1;
  s.constraints.value(7) = 0.3;
  s.stiffness_scale = 2;
  if (t.unilateral) s.unilateral.assign(s.B.rows(), 1);
  return s;
}

TEST(Substructures, AreTheSystemsOwnBlocks) {
  const SaddlePointSystem s = tower(4);
  const Substructures all(s);
  ASSERT_EQ(all.size(), 4u);
  MatX K = MatX::Zero(s.K.rows(), s.K.cols()), B = MatX::Zero(s.B.rows(), s.B.cols());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Substructure own = all[k];
    K(own.unknowns, own.unknowns) += MatX(own.system.K);
    B(own.rows, own.unknowns) += MatX(own.system.B);
    for (std::size_t i = 0; i < own.springs.size(); ++i)
      EXPECT_EQ(own.unknowns[own.system.grounded[i]], s.grounded[own.springs[i]]);
    EXPECT_EQ(own.system.f, VecX(s.f(own.unknowns)));
    EXPECT_EQ(own.system.row_scale, VecX(s.row_scale(own.rows)));
    for (std::size_t i = 0; i < own.unknowns.size(); ++i)
      EXPECT_EQ(own.system.constraints.fixed[i], s.constraints.fixed[own.unknowns[i]]);
  }
  EXPECT_EQ(K, MatX(s.K));
  EXPECT_EQ(B, MatX(s.B));
}

TEST(Substructures, AreAlikeByStiffnessSupportsAndContact) {
  const auto first = [](const SaddlePointSystem& s) { return first_alike(Substructures(s)); };
  SaddlePointSystem s = tower(6);
  EXPECT_EQ(first(s),
            (std::vector<int>{0, 1, 1, 1, 1, 5}));  // the lowest is held, the uppermost has contact below only
  s.constraints.fixed[2 * nodes * 2 + 3] = 1;
  EXPECT_EQ(first(s), (std::vector<int>{0, 1, 2, 1, 1, 5}));
  double& entry = s.K.coeffRef(2 * nodes * 3 + 4, 2 * nodes * 3 + 4);
  const double value = entry;
  entry = value * (1 + 1e-13);  // round-off
  EXPECT_EQ(first(s), (std::vector<int>{0, 1, 2, 1, 1, 5}));
  entry = value * (1 + 1e-8);
  EXPECT_EQ(first(s), (std::vector<int>{0, 1, 2, 3, 1, 5}));
  EXPECT_EQ(first(tower(3, {.contrast = 10})), (std::vector<int>{0, 1, 2}));
}

void expect_same(const Solution& found, const Solution& direct, double tolerance) {
  ASSERT_EQ(found.status, SolveStatus::converged);
  ASSERT_EQ(direct.status, SolveStatus::converged);
  EXPECT_LE(largest_entry(found.lambda - direct.lambda), tolerance * largest_entry(direct.lambda));
  EXPECT_LE(largest_entry(found.u - direct.u), tolerance * largest_entry(direct.u));
  EXPECT_EQ(found.active, direct.active);
  EXPECT_LE(found.constraint_residual, 1e-10);
  EXPECT_LE(found.force_residual, 1e-10);
}

TEST(Feti, AgreesWithTheDirectMethodForAnyStiffnesses) {
  for (const auto& [contrast, bodies] : {std::pair{1.0, 2}, {1.0, 30}, {1e3, 2}, {1e3, 8}, {1e6, 4}}) {
    SCOPED_TRACE(std::to_string(contrast) + ", " + std::to_string(bodies));
    const SaddlePointSystem s = tower(bodies, {.contrast = contrast});
    expect_same(solve_by_feti(s, {}), solve_directly(s), 1e-8);
  }
}

// What is left of the parts' small differences is solved for in the end.
TEST(Feti, SharesFactorsOfPartsThatAreAlikeToRoundOff) {
  for (const double difference : {0.0, 1e-12, 1e-6}) {
    SaddlePointSystem s = tower(20);
    for (int i = 0; i < s.K.cols(); ++i) s.K.coeffRef(i, i) *= 1 + difference * std::sin(i);
    expect_same(solve_by_feti(s, {}), solve_directly(s), 1e-8);
  }
}

TEST(Feti, OpensTheRowsThatTheDirectMethodOpens) {
  SaddlePointSystem s = tower(12, {.contrast = 10, .unilateral = true});
  for (int b = 2; b < 12; b += 3) {  // pulled apart within themselves
    s.f(2 * nodes * b + 1) += 20;
    s.f(2 * (nodes * b + 1) + 1) -= 20;
  }
  const Solution direct = solve_directly(s);
  const auto open = std::ranges::count(direct.active, 0);
  EXPECT_GT(open, 0);
  EXPECT_LT(open, s.B.rows());
  expect_same(solve_by_feti(s, {}), direct, 1e-8);
}

// A gap that is drawn far wider than anything moves hides no overlap of another row, of a hundred times what counts as
// none.
TEST(Feti, ClosesARowThatOverlapsALittleBesideAWideGap) {
  for (const double wide : {1e2, 1e4, 1e6}) {
    SaddlePointSystem s = tower(2, {.unilateral = true});
    s.grounded.clear();  // held, both
    for (const int unknown : {2 * nodes + 4, 2 * nodes + 5, 2 * nodes + 11}) s.constraints.fixed[unknown] = 1;
    s.g(2) = s.g(3) = -wide;
    const Solution open = solve_by_feti(s, {});
    ASSERT_EQ(open.status, SolveStatus::converged);
    s.g(3) = (s.B * open.u)(3) + 1e-7 * largest_entry(open.u);
    s.start = {open.active.begin(), open.active.end()};
    const Solution found = solve_by_feti(s, {});
    EXPECT_TRUE(found.active[3]) << wide;
    EXPECT_FALSE(found.active[2]) << wide;
    EXPECT_EQ(found.active, solve_directly(s).active) << wide;
  }
}

// The lowest ring has a node that is moved up or down, away from the row on it.
TEST(Feti, OpensTheRowsThatAPrescribedDisplacementOpens) {
  std::vector<std::ptrdiff_t> open;
  for (const double value : {-300.0, 0.3, 300.0}) {
    SaddlePointSystem s = tower(6, {.unilateral = true});
    s.constraints.value(7) = value;
    const Solution direct = solve_directly(s);
    open.push_back(std::ranges::count(direct.active, 0));
    expect_same(solve_by_feti(s, {}), direct, 1e-8);
  }
  EXPECT_GT(open.front() + open.back(), 0);
}

// A beam, held by one end, whose every other node touches a ring of springs, three a ring. Every other ring is held by
// one node, the others lie on the beam.
SaddlePointSystem beam_and_rings(int rings, double stiffness = 1) {
  const int length = 6 * rings;  // nodes
  SaddlePointSystem s;
  Triplets K, B;
  const auto spring = [&](int a, int b, double k) {
    for (int c = 0; c < 2; ++c) {
      const int one = 2 * a + c, other = 2 * b + c;
      K.emplace_back(one, one, k);
      K.emplace_back(other, other, k);
      K.emplace_back(std::max(one, other), std::min(one, other), -k);
    }
  };
  const double bend[] = {1, -2, 1};
  for (int i = 0; i + 1 < length; ++i) K.emplace_back(2 * i + 2, 2 * i, -1);
  for (int i = 0; i < length; ++i) K.emplace_back(2 * i, 2 * i, 2);
  for (int i = 0; i + 2 < length; ++i)
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b <= a; ++b) K.emplace_back(2 * (i + a) + 1, 2 * (i + b) + 1, bend[a] * bend[b]);
  std::vector<int> held = {0, 1, 3};
  int row = 0;
  for (int r = 0; r < rings; ++r) {
    const int first = length + nodes * r;
    for (int i = 0; i < nodes; ++i) spring(first + i, first + (i + 1) % nodes, stiffness * (1 + 0.1 * i));
    for (int i = 0; i < 3; ++i, ++row) {
      B.emplace_back(row, 2 * (first + i) + 1, 1);
      B.emplace_back(row, 2 * (6 * r + 2 * i) + 1, -1);
    }
    held.push_back(2 * (first + 4));
    if (r % 2 == 0) held.push_back(2 * (first + 4) + 1);
    if (r % 2 == 1) s.grounded.push_back(2 * first + 1);
  }
  const int n = 2 * (length + nodes * rings);
  s.K.resize(n, n);
  s.K.setFromTriplets(K.begin(), K.end());
  s.B.resize(row, n);
  s.B.setFromTriplets(B.begin(), B.end());
  s.f = VecX::LinSpaced(n, -1, -2);
  s.f(Eigen::seqN(1, length, 2)).setConstant(2);  // against the rings
  s.g = VecX::LinSpaced(row, 0.1, -0.1);
  s.row_scale = VecX::LinSpaced(row, 1, 2);
  s.constraints = {std::vector<char>(n, 0), VecX::Zero(n)};
  for (const int unknown : held) s.constraints.fixed[unknown] = 1;
  s.stiffness_scale = 2;
  return s;
}

std::vector<double> slender_beam(int rings) { return std::vector<double>(6 * rings, 100); }

// Of few rows for its nodes, which has a full compliance, and of many.
TEST(Feti, TakesFewStepsWithASlenderPart) {
  for (const int rings : {30, 50})
    for (const bool unilateral : {false, true}) {
      SCOPED_TRACE(testing::Message() << rings << unilateral);
      SaddlePointSystem s = beam_and_rings(rings);
      if (unilateral) s.unilateral.assign(s.B.rows(), 1);
      if (unilateral) s.f(Eigen::seqN(5 * rings + 1, 10, 2)).setConstant(-9);  // away from them
      const Solution direct = solve_directly(s), found = solve_by_feti(s, {}, slender_beam(rings));
      EXPECT_EQ(std::ranges::count(direct.active, 0) > 0, unilateral);
      expect_same(found, direct,
                  1e-17 * std::pow(6 * rings, 4));  // a beam's condition is the fourth power of its nodes
      EXPECT_LE(found.iteration->steps, 30 + 4 * int(found.steps.size()));  // 574 closed, by the nodes' stiffness
    }
}

// Rows and gaps in other units of length, forces to depth with them.
TEST(Feti, SolvesSlenderPartsInAnyUnits) {
  for (const int rings : {30, 50}) {
    const SaddlePointSystem s = beam_and_rings(rings);
    const Solution in_metres = solve_by_feti(s, {}, slender_beam(rings));
    for (const double unit : {0x1p-10, 0x1p10}) {
      SCOPED_TRACE(testing::Message() << rings << " " << unit);
      SaddlePointSystem other = s;
      other.B *= unit;
      other.row_scale *= unit;
      other.f *= unit;
      other.g *= unit * unit;
      const Solution found = solve_by_feti(other, {}, slender_beam(rings));
      EXPECT_EQ(found.iteration->steps, in_metres.iteration->steps);
      EXPECT_LE(largest_entry(found.lambda - in_metres.lambda), 1e-12 * largest_entry(in_metres.lambda));
      EXPECT_LE(largest_entry(found.u / unit - in_metres.u), 1e-12 * largest_entry(in_metres.u));
      const VecX local = DualSystem(s, slender_beam(rings)).diagonal;
      EXPECT_LE(largest_entry(DualSystem(other, slender_beam(rings)).diagonal - local), 1e-12 * largest_entry(local));
    }
  }
}

// Gaps far smaller than what moves, in a beam that the loads alone would bend much further.
TEST(Feti, LeavesNoOverlapOfSlenderParts) {
  constexpr int rings = 50;
  SaddlePointSystem s = beam_and_rings(rings, 1e5);
  s.unilateral.assign(s.B.rows(), 1);
  s.f(Eigen::seqN(0, 6 * rings, 2)).setZero();  // nothing stretches the beam
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int i = 0; i < 20; ++i) {
    s.g = VecX::NullaryExpr(s.B.rows(), [&] { return 1e-6 * part(random); });
    s.start.assign(s.B.rows(), 1);
    for (char& closed : s.start) closed = part(random) < 0.9;
    const Solution found = solve_by_feti(s, {}, slender_beam(rings));
    ASSERT_EQ(found.status, SolveStatus::converged);
    const VecX gap = (s.B * found.u - s.g).cwiseQuotient(s.row_scale);
    EXPECT_GE(gap.minCoeff(), -1e-9 * largest_entry(found.u)) << i;
  }
}

TEST(Feti, NamesTheMotionThatTheLoadDrives) {
  const SaddlePointSystem s = tower(4, {.unilateral = true, .lift = 1e3});
  const Solution direct = solve_directly(s), found = solve_by_feti(s, {});
  EXPECT_EQ(direct.status, SolveStatus::unconstrained);
  EXPECT_EQ(found.status, SolveStatus::unconstrained);
  EXPECT_GT(found.driven_mode(5), 0.9 * largest_entry(found.driven_mode));
  EXPECT_GT(direct.driven_mode(5), 0.9 * largest_entry(direct.driven_mode));
}

TEST(Feti, HoldsAMotionThatNoRowHoldsAndNoLoadDrives) {
  SaddlePointSystem s = tower(3);
  s.B = MatX(MatX(s.B)(std::vector<int>{0, 1, 2, 3, 5, 7}, Eigen::all)).sparseView();  // the third may move along x
  s.row_scale = VecX::Ones(6);
  s.g = VecX::Zero(6);
  for (int i = 2 * nodes * 2; i < s.f.size(); i += 2) s.f(i) = 0;
  const Solution direct = solve_directly(s), found = solve_by_feti(s, {});
  expect_same(found, direct, 1e-8);
  ASSERT_EQ(found.rigid_modes.cols(), 1);
  EXPECT_LE((found.rigid_modes - direct.rigid_modes).norm(), 1e-8);
}

// One row a direction between each two bodies, and loads on none but the lowest: motions alone close the gaps, and what
// is left is round-off, with no pressure that it could be compared with.
TEST(Feti, FindsNoPressureWhereMotionsCloseAllGaps) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> count(2, 8);
  std::uniform_real_distribution<double> gap(-1, 1);
  for (int i = 0; i < 40; ++i) {
    const int bodies = count(random);
    SaddlePointSystem s = tower(bodies, {.contrast = 100});
    Triplets B;
    for (int b = 1; b < bodies; ++b)
      for (int c = 0; c < 2; ++c) {
        B.emplace_back(2 * (b - 1) + c, 2 * nodes * b + c, 1);
        B.emplace_back(2 * (b - 1) + c, 2 * (nodes * (b - 1) + 3) + c, -1);
      }
    s.B.resize(2 * (bodies - 1), s.K.rows());
    s.B.setFromTriplets(B.begin(), B.end());
    s.g = VecX::NullaryExpr(s.B.rows(), [&] { return gap(random); });
    s.row_scale = VecX::LinSpaced(s.B.rows(), 1, 2);
    if (i % 2) s.f.setZero();  // nor is there any energy to compare with
    s.f.tail(2 * nodes * (bodies - 1)).setZero();
    const Solution found = solve_by_feti(s, {}), direct = solve_directly(s);
    ASSERT_EQ(found.status, SolveStatus::converged) << i;
    EXPECT_LE(largest_entry(found.lambda), 1e-10) << i;
    EXPECT_LE(largest_entry(found.u - direct.u), 1e-9 * largest_entry(direct.u)) << i;
  }
}

TEST(Feti, NamesARowThatTheOthersImply) {
  SaddlePointSystem s = tower(3);
  MatX B(s.B);
  B.row(7) = B.row(5);
  s.B = B.sparseView();
  const Solution found = solve_by_feti(s, {});
  EXPECT_EQ(found.status, SolveStatus::dependent_row);
  EXPECT_TRUE(found.failed_at == 5 || found.failed_at == 7) << found.failed_at;
}

TEST(Feti, NamesAnUnknownThatNothingHolds) {
  SaddlePointSystem s = tower(3);
  const int unknown = 2 * nodes * 2 + 5;
  for (int j = 0; j < s.K.cols(); ++j)
    for (SparseMatrix::InnerIterator it(s.K, j); it; ++it)
      if (it.row() == unknown || j == unknown) it.valueRef() = 0;
  const Solution found = solve_by_feti(s, {});
  EXPECT_EQ(found.status, SolveStatus::not_positive_definite);
  EXPECT_EQ(found.failed_at, unknown);
}

TEST(Feti, SaysThatItDidNotConverge) {
  EXPECT_EQ(solve_by_feti(tower(30, {.contrast = 1e3}), {.max_iterations = 2}).status, SolveStatus::not_converged);
}

TEST(Feti, ItsDualsAreThoseOfTheDirectFactor) {
  const SaddlePointSystem s = tower(6, {.contrast = 10});
  const Solution direct = solve_directly(s), found = solve_by_feti(s, {});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-1, 1);
  constexpr int count = 19, loaded = 2;  // several blocks, in which each ends when it is found
  MatX rows = MatX::Zero(s.B.rows(), count), loads = MatX::Zero(s.f.size(), loaded);
  for (int k = 1; k < count; ++k)  // the first asks for nothing
    for (Eigen::Index a = k % rows.rows(); a < rows.rows(); a += k) rows(a, k) = part(random);
  loads.col(0).setLinSpaced(1, -1);
  loads.col(1).setOnes();
  const MatX expected = direct.factor->duals(rows, loads), duals = found.factor->duals(rows, loads);
  EXPECT_TRUE(duals.col(0).isZero(0));
  for (int k = 1; k < count; ++k) EXPECT_LE((duals - expected).col(k).norm(), 1e-4 * expected.col(k).norm()) << k;
}

}  // namespace
}  // namespace mortise
