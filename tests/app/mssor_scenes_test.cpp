// The iterative solver from scene to results: the direct solver's answer, and what is said where there is none.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "app/sweep.hpp"
#include "preprint_solvers/mssor.hpp"
#include "results/report_text.hpp"
#include "results/write_results.hpp"
#include "support/differences.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

using Overrides = std::vector<Override>;

std::string scene_file(const std::string& name) { return std::string(MORTISE_SOURCE_DIR) + "/geo/" + name + ".toml"; }

Results run_mssor(const std::string& name, Overrides overrides, const Overrides& more = {}) {
  overrides.insert(overrides.end(), more.begin(), more.end());
  return solve_scene(read_scene(scene_file(name), overrides));
}

Overrides mssor(Overrides overrides, const std::string& acceleration = "krylov") {
  overrides.push_back({"method.solver", "mssor"});
  overrides.push_back({"method.acceleration", acceleration});
  return overrides;
}

Overrides mssor_plates(int upper, int lower, int kind = 0, int order = 2) {
  return {{"mesh.parameters.n_upper", std::to_string(upper)},
          {"mesh.parameters.n_lower", std::to_string(lower)},
          {"mesh.parameters.kind", std::to_string(kind)},
          {"mesh.parameters.order", std::to_string(order)}};
}

void expect_as_direct(const Results& a, const Results& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_LT(pressure_difference(a, b), 1e-8);
  EXPECT_LT(largest_entry(a.solution.u - b.solution.u), 1e-8 * largest_entry(b.solution.u));
  ASSERT_TRUE(a.solution.iteration.has_value());
  EXPECT_GT(a.solution.iteration->steps, 10);
  EXPECT_FALSE(b.solution.iteration.has_value());
}

TEST(SolveMssor, IsTheDirectSolversAnswer) {
  for (const char* acceleration : {"none", "krylov", "minres"})
    for (const auto& [kind, order] : {std::pair{0, 2}, {1, 1}, {1, 2}, {0, 1}}) {
      const Overrides mesh = mssor_plates(8, 10, kind, order);
      expect_as_direct(run_mssor("parabola_1", mssor(mesh, acceleration)), run_mssor("parabola_1", mesh));
    }
}

TEST(SolveMssor, IsTheDirectSolversAnswerOnOtherScenes) {
  // three bodies, unilateral and closed; a gap that is measured; a kink; multipliers of other spaces
  expect_as_direct(run_mssor("stack", mssor({})), run_mssor("stack", {}));
  expect_as_direct(run_mssor("shrink_fit", mssor({})), run_mssor("shrink_fit", {}));
  const Overrides mesh = mssor_plates(16, 20);
  expect_as_direct(run_mssor("tent_c", mssor(mesh)), run_mssor("tent_c", mesh));
  for (const char* space : {"dual", "quadratic"}) {
    const Overrides other = {{"method.multipliers", space}};
    expect_as_direct(run_mssor("patch_inclined", mssor(other)), run_mssor("patch_inclined", other));
  }
}

TEST(SolveMssor, ALooseToleranceIsWhatTheChecksAskFor) {
  const Results r = run_mssor("patch_flat", mssor({{"method.tolerance", "1e-6"}}));
  EXPECT_EQ(r.status, Status::solved);
  EXPECT_LE(r.checks[0].value, 1e-6);
  EXPECT_EQ(r.checks[0].limit, 1e-6);
  EXPECT_LT(r.solution.iteration->steps, run_mssor("patch_flat", mssor({})).solution.iteration->steps);
}

TEST(SolveMssor, OpeningContactIsRefused) {
  const std::string text = message_of([] { run_mssor("lift_off", mssor({})); });
  EXPECT_NE(text.find("contact is in tension here"), std::string::npos) << text;
  EXPECT_NE(text.find("solver = \"direct\""), std::string::npos) << text;
}

TEST(SolveMssor, DivergenceNamesTheBorderAndTheBorderHolds) {
  Overrides mesh = mssor_plates(8, 10);
  const double limit = run_mssor("parabola_1", mssor(mesh, "none")).solution.iteration->figures.back().second;
  ASSERT_GT(limit, 0);
  mesh.push_back({"method.tau", std::to_string(1.05 * limit)});
  const Results r = run_mssor("parabola_1", mssor(mesh, "none"));
  EXPECT_EQ(r.status, Status::not_converged);
  ASSERT_FALSE(r.warnings.empty());
  EXPECT_NE(r.warnings[0].find("diverges"), std::string::npos) << r.warnings[0];
  EXPECT_NE(r.warnings[0].find("converges for tau below"), std::string::npos) << r.warnings[0];
  mesh.back().value = std::to_string(0.95 * limit);
  EXPECT_NE(run_mssor("parabola_1", mssor(mesh, "none")).status, Status::not_converged);
}

TEST(SolveMssor, TooFewStepsAreNotConverged) {
  const Results r = run_mssor("patch_flat", mssor({{"method.max_iterations", "5"}}));
  EXPECT_EQ(r.status, Status::not_converged);
  EXPECT_EQ(r.solution.iteration->steps, 5);
  ASSERT_FALSE(r.warnings.empty());
  EXPECT_NE(r.warnings[0].find("did not converge: after 5 steps"), std::string::npos) << r.warnings[0];
}

TEST(SolveMssor, TheSummarySaysHow) {
  const Scene scene = read_scene(scene_file("patch_flat"), mssor({{"method.omega", "1.1"}, {"method.tau", "0.5"}}));
  const Results r = solve_scene(scene);
  const Json summary = report_of(r);
  EXPECT_EQ(summary["method"]["solver"], "mssor");
  EXPECT_EQ(summary["iterations"]["solver"], r.solution.iteration->steps);
  EXPECT_EQ(summary["iterations"]["contact"], 1);
  EXPECT_EQ(summary["iteration"]["omega"], 1.1);
  EXPECT_EQ(summary["iteration"]["tau"], 0.5);
  EXPECT_LE(summary["iteration"]["force"].get<double>(), 1e-10);
  EXPECT_NE(report_text(summary, "out").find("mssor, acceleration krylov, omega 1.1, tau 0.5"), std::string::npos);
}

TEST(SolveMssor, ASweepVariesItsParameters) {
  CaseSolver solver;
  std::set<double> steps;
  for (const char* omega : {"0.8", "1.3"})
    for (const char* tau : {"0.5", "1"}) {
      const RunRow row =
          solve_run(scene_file("patch_flat"), mssor({{"method.omega", omega}, {"method.tau", tau}}), false, solver);
      EXPECT_EQ(row.status, "solved");
      const auto found = std::ranges::find(row.figures, "iteration.steps", &std::pair<std::string, double>::first);
      ASSERT_NE(found, row.figures.end());
      steps.insert(found->second);
    }
  EXPECT_GT(steps.size(), 1u);
}

TEST(SolveMssor, WhatOverflowsIsNotSolved) {
  for (const char* acceleration : {"none", "krylov", "minres"}) {
    for (const char* y : {"-1e300", "-1e308"}) {
      const std::string top = std::string("{ on = [\"top\"], displacement = { y = ") + y + " } }";
      EXPECT_EQ(run_mssor("patch_flat", mssor({{"boundary.2", top}}, acceleration)).status, Status::not_converged);
    }
    const Overrides tau = {{"method.tau", "1e300"}, {"method.max_iterations", "200"}};
    const Results r = run_mssor("patch_flat", mssor(tau, acceleration));
    EXPECT_TRUE(r.status == Status::not_converged || r.solution.u.allFinite());
  }
}

}  // namespace
}  // namespace mortise::test
