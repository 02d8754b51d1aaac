// The iterations between two groups: the exact multipliers are their fixed point, and the direct solver's.
#include "preprint_solvers/interface.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "base/dense.hpp"
#include "preprint_solvers/solve_ddm.hpp"
#include "solve/direct.hpp"
#include "support/two_groups.hpp"

namespace mortise {
namespace {

using test::two_groups;
using test::TwoGroups;

Interface interface_of(const TwoGroups& g) {
  const SaddlePointSystem& s = g.system;
  std::vector<int> all(g.m);
  std::iota(all.begin(), all.end(), 0);
  return make_interface(BodyGroup(s, g.second), BodyGroup(s, g.first),
                        (s.B * s.constraints.value - s.g).cwiseQuotient(s.row_scale), s.row_scale, all);
}

// Dimensionless: over the stiffness, times the rows' scales.
VecX exact_multipliers(const TwoGroups& g) {
  return solve_directly(g.system).lambda.cwiseProduct(g.system.row_scale) / g.system.stiffness_scale;
}

class Schemes : public testing::TestWithParam<bool> {};

TEST_P(Schemes, HaveTheExactMultipliersAsFixedPoint) {
  const TwoGroups g = two_groups(GetParam());
  const Interface interface = interface_of(g);
  const VecX exact = exact_multipliers(g);
  for (const InterfaceIteration& iteration : {neumann_dirichlet(interface), dirichlet_dirichlet(interface)}) {
    ASSERT_EQ(iteration.dependent_row, -1);
    EXPECT_LE(largest_entry(iteration.correction(exact)), 1e-11 * largest_entry(exact));
    EXPECT_GT(largest_entry(iteration.correction(2 * exact)), 1e-3 * largest_entry(exact));
  }
  const VecX z = VecX::Zero(g.m);
  EXPECT_LE(residuals(interface, exact, z).largest(), 1e-11);
  EXPECT_GT(residuals(interface, exact, VecX::Constant(g.m, 0.1)).kinematic, 1e-4);
  EXPECT_GT(residuals(interface, exact, VecX::Constant(g.m, 0.1)).force, 1e-4);
}

TEST_P(Schemes, ComeToTheDirectSolversAnswer) {
  const TwoGroups g = two_groups(GetParam());
  const Solution direct = solve_directly(g.system);
  for (const Scheme scheme : {Scheme::neumann_dirichlet, Scheme::neumann_neumann, Scheme::dirichlet_dirichlet})
    for (const std::vector<char>& dirichlet : {g.first, g.second}) {
      const Solution s = solve_by_ddm(g.system, dirichlet, {.scheme = scheme, .beta = {}, .tolerance = 1e-11});
      ASSERT_EQ(s.status, SolveStatus::converged) << to_string(scheme);
      EXPECT_LE(largest_entry(s.u - direct.u), 1e-9 * largest_entry(direct.u)) << to_string(scheme);
      EXPECT_LE(largest_entry(s.lambda - direct.lambda), 1e-9 * largest_entry(direct.lambda)) << to_string(scheme);
      EXPECT_EQ(s.iteration->method, to_string(scheme));
      EXPECT_EQ(std::size_t(s.iteration->steps), s.iteration->history.size());
    }
}

INSTANTIATE_TEST_SUITE_P(HeldAndFloating, Schemes, testing::Bool());

TEST(Interface, TheSpectrumsEndsAreThoseOfTheIterationsMatrix) {
  const TwoGroups g = two_groups(false);
  const Interface interface = interface_of(g);
  const InterfaceIteration iteration = neumann_dirichlet(interface);
  MatX A(g.m, g.m);  // x -> z(0) - z(x)
  for (int k = 0; k < g.m; ++k)
    A.col(k) = iteration.correction(VecX::Zero(g.m)) - iteration.correction(VecX::Unit(g.m, k));
  const VecX sizes = eigenvalues(A).cwiseAbs();
  const Spectrum found = spectrum(iteration, g.m);
  EXPECT_NEAR(found.smallest, sizes.minCoeff(), 1e-8 * sizes.maxCoeff());
  EXPECT_NEAR(found.largest, sizes.maxCoeff(), 1e-8 * sizes.maxCoeff());
  EXPECT_NEAR(found.convergence_rate(found.best_beta()),
              (found.largest - found.smallest) / (found.largest + found.smallest), 1e-12);
}

TEST(Interface, AGroupThatDoesNotFeelARowSaysSo) {
  TwoGroups g = two_groups(false);
  MatX B = g.system.B;
  B.row(2).head(g.n) = 3 * B.row(1).head(g.n);  // for the first body these are one
  g.system.B = B.sparseView();
  EXPECT_EQ(neumann_dirichlet(interface_of(g)).dependent_row, 2);
  const Solution s = solve_by_ddm(g.system, g.first, {.beta = {}});
  EXPECT_EQ(s.status, SolveStatus::dependent_row);
  EXPECT_EQ(s.failed_at, 2);
  EXPECT_NE(s.advice.find("expected contact.multipliers_on"), std::string::npos);
}

}  // namespace
}  // namespace mortise
