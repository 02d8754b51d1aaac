// Dual solutions: what a load does to a functional of the multipliers, told before the load is there.
#include "solve/contact_factor.hpp"

#include <gtest/gtest.h>

#include "solve/direct.hpp"
#include "support/two_groups.hpp"

namespace mortise {
namespace {

TEST(ContactFactor, DualsTellWhatLoadsDoToTheMultipliers) {
  for (const bool floats : {false, true}) {
    SaddlePointSystem system = test::two_groups(floats).system;
    system.constraints.fixed[3] = 1;
    const Eigen::Index n = system.f.size(), m = system.g.size();
    const Solution before = solve_directly(system);
    ASSERT_EQ(before.status, SolveStatus::converged);
    const VecX w = VecX::LinSpaced(m, -1, 2);
    const VecX z = before.factor->duals(w);
    EXPECT_EQ(z(3), 0);
    EXPECT_LE((system.B * z - w).norm(), 1e-10);

    const VecX load = VecX::LinSpaced(n, 1, -0.5);
    system.f += load;
    const Solution after = solve_directly(system);
    EXPECT_NEAR(w.dot(after.lambda - before.lambda), z.dot(load), 1e-10 * z.norm() * load.norm()) << floats;
    EXPECT_GT(std::abs(z.dot(load)), 1e-3);
    EXPECT_LE((factorise_contact(system, after.active)->duals(w) - z).norm(), 1e-12 * z.norm());
  }
}

TEST(ContactFactor, DualsOfLoadsTellWhatLoadsDoToTheDisplacements) {
  SaddlePointSystem system = test::two_groups(false).system;
  system.constraints.fixed[3] = 1;
  const Eigen::Index n = system.f.size(), m = system.g.size();
  const Solution before = solve_directly(system);
  const VecX g = VecX::LinSpaced(n, -1, 1.5), load = VecX::LinSpaced(n, 1, -0.5), w = VecX::LinSpaced(m, -1, 2);
  MatX functionals = MatX::Zero(m, 3);
  functionals.col(0) = functionals.col(2) = w;
  MatX loads = MatX::Zero(n, 2);
  loads.col(0) = loads.col(1) = g;
  const MatX z = before.factor->duals(functionals, loads);
  EXPECT_EQ(z.row(3).norm(), 0);
  EXPECT_LE((system.B * z.col(1)).norm(), 1e-10);
  EXPECT_LE((system.B * z.col(2) - w).norm(), 1e-10);
  EXPECT_LE((z.col(0) + z.col(1) - z.col(2)).norm(), 1e-10 * z.norm());
  system.f += load;
  const Solution after = solve_directly(system);
  EXPECT_NEAR(g.dot(after.u - before.u), z.col(1).dot(load), 1e-10 * z.norm() * load.norm());
  EXPECT_GT(std::abs(z.col(1).dot(load)), 1e-3);
}

TEST(ContactFactor, OpenRowsTakeNoPart) {
  const SaddlePointSystem system = test::two_groups(false).system;
  std::vector<char> closed(system.g.size(), 1);
  closed[1] = 0;
  VecX w = VecX::Ones(system.g.size());
  const auto factor = factorise_contact(system, closed);
  const VecX z = factor->duals(w), opening = system.B * z;
  EXPECT_NEAR(opening(0), 1, 1e-10);
  EXPECT_GT(std::abs(opening(1) - 1), 1e-6);
  w(1) = 5;
  EXPECT_EQ(VecX(factor->duals(w)), z);
}

TEST(ContactFactor, ManyDualsAreEachOnesOwn) {
  const SaddlePointSystem system = test::two_groups(true).system;
  const auto factor = factorise_contact(system, std::vector<char>(system.g.size(), 1));
  MatX w(system.g.size(), 3);
  w << MatX::Identity(w.rows(), 2), VecX::Ones(w.rows());
  const MatX z = factor->duals(w);
  for (int k = 0; k < 3; ++k) EXPECT_LE((factor->duals(w.col(k)) - z.col(k)).norm(), 1e-13 * z.norm());
  EXPECT_EQ(factor->duals(MatX(w.rows(), 0)).cols(), 0);
}

}  // namespace
}  // namespace mortise
