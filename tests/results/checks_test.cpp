// Checks are tried by answers that are wrong: none may pass what is no number, has the wrong sign or lies elsewhere.
#include "results/checks.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "app/solve_scene.hpp"
#include "results/warnings.hpp"
#include "support/plate_scenes.hpp"

namespace mortise::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Scene unilateral_scene() {
  Scene s = uniaxial_scene();
  s.contacts[0].condition = Condition::unilateral;
  return s;
}

// The answer of a scene, with what `spoil` makes of it, judged anew.
template <typename Spoil>
Results judged(const Scene& scene, Spoil spoil) {
  Results r = solve_scene(scene, mesh_of({}));
  EXPECT_EQ(r.status, Status::solved);
  spoil(r.solution, r);
  r.recovery.reactions = find_reactions(r.problem, r.solution);
  r.checks = checks(r);
  r.status = verdict(r);
  r.warnings = warnings(r, large_displacement(r));
  return r;
}

std::set<std::string> failed(const Results& r) {
  std::set<std::string> names;
  for (const Check& check : r.checks)
    if (!check.ok()) names.insert(check.name);
  return names;
}

TEST(Checks, HoldForTheAnswerItself) {
  const Results r = judged(unilateral_scene(), [](Solution&, Results&) {});
  EXPECT_EQ(r.status, Status::solved);
  EXPECT_TRUE(failed(r).empty());
}

// Stiffness times displacement is a million times the loads there, and so is its round-off.
TEST(Checks, HoldWhereTheMaterialHardlyChangesItsVolume) {
  Scene scene = uniaxial_scene();
  for (const double poisson : {0.4999, 0.499999, 0.4999999}) {
    scene.materials["steel"].poisson = poisson;
    const Results r = solve_scene(scene, mesh_of({}));
    EXPECT_EQ(r.status, Status::solved) << poisson;
    EXPECT_TRUE(failed(r).empty()) << *failed(r).begin();
  }
}

TEST(Checks, EveryOneFailsOnWhatIsNoNumber) {
  std::set<std::string> never_failed;
  for (const Check& check : judged(unilateral_scene(), [](Solution&, Results&) {}).checks)
    never_failed.insert(check.name);
  for (int part = 0; part < 5; ++part) {
    const Results r = judged(unilateral_scene(), [&](Solution& s, Results& results) {
      if (part == 0) s.u(s.u.size() / 2) = nan;
      if (part == 1) s.lambda(s.lambda.size() / 2) = nan;
      if (part == 2) s.force_residual = s.constraint_residual = nan;
      if (part == 3) results.recovery.contacts[0].p_least = nan;
      if (part == 4) results.problem.pairs[0].coupling.covered_length = nan;
    });
    EXPECT_NE(r.status, Status::solved) << part;
    for (const std::string& name : failed(r)) never_failed.erase(name);
  }
  for (const std::string& name : never_failed) ADD_FAILURE() << name;
}

TEST(Checks, WhatIsNotFiniteHasNotConverged) {
  for (const double value : {nan, std::numeric_limits<double>::infinity()})
    for (int part = 0; part < 6; ++part) {
      const Results r = judged(unilateral_scene(), [&](Solution& s, Results& results) {
        if (part == 0) s.u(0) = value;
        if (part == 1) s.lambda(0) = value;
        if (part == 2) results.recovery.stress.points(0, 2) = value;
        if (part == 3) results.recovery.energy = value;
        if (part == 4) results.recovery.contacts[0].force.x() = value;
        if (part == 5) s.force_residual = value;  // as of a load that is no number
      });
      EXPECT_EQ(r.status, Status::not_converged) << part;
      ASSERT_FALSE(r.warnings.empty());
      EXPECT_EQ(r.warnings[0].rfind("not finite", 0), 0u) << r.warnings[0];
      EXPECT_NE(r.warnings[0].find("; discard these results"), std::string::npos) << r.warnings[0];
    }
}

TEST(Checks, APressureOfTheWrongSignFails) {
  const Results r = judged(unilateral_scene(), [](Solution& s, Results&) { s.lambda *= -1; });
  EXPECT_TRUE(failed(r).contains("p >= 0 at the multipliers"));
  EXPECT_TRUE(failed(r).contains("force balance of each body"));
  EXPECT_EQ(r.status, Status::check_failed);
}

TEST(Checks, AHundredMillionthOfAnotherPressureFails) {
  const Results r = judged(unilateral_scene(), [](Solution& s, Results&) { s.lambda *= 1 + 1e-8; });
  EXPECT_TRUE(failed(r).contains("force balance of each body"));
}

TEST(Checks, AnOverlapFails) {
  const Results r = judged(unilateral_scene(), [](Solution& s, Results& results) {
    const ContactNode& n = results.recovery.contacts[0].multiplier.nodes[2];
    s.u.segment<2>(2 * n.node) += 1e-6 * largest_entry(s.u) * n.normal;
  });
  EXPECT_TRUE(failed(r).contains("weighted gap >= 0"));
}

}  // namespace
}  // namespace mortise::test
