// [[expect]]: figures and pressures that a scene says, right and wrong ones.
#include "results/expected.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "app/solve_scene.hpp"
#include "results/report.hpp"
#include "results/report_text.hpp"

namespace mortise::test {
namespace {

// geo/patch_flat: two blocks under a uniform pressure.
Results judged(std::vector<Expectation> expectations, bool with_estimate = true) {
  Scene scene = read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/patch_flat.toml");
  scene.expectations = std::move(expectations);
  Results r = solve_scene(scene);
  if (with_estimate) estimate(r);
  judge_expectations(r);
  return r;
}

double largest_pressure() { return report_of(judged({}))["contact"][0]["pressure"]["max"]; }

Expectation figure(const std::string& name, double value, double tolerance) {
  return {.key = "expect.0", .figure = name, .value = value, .tolerance = tolerance, .source = "statics"};
}

Expectation pressure(Field value, double tolerance, int pair = 0) {
  return {.key = "expect.0", .value = std::move(value), .pair = pair, .tolerance = tolerance};
}

TEST(Expected, FiguresHoldWithinTheirTolerance) {
  const double p = largest_pressure();
  const Results right = judged({figure("contact.0.pressure.max", p / 1.01, 0.0101)});
  EXPECT_EQ(right.status, Status::solved);
  EXPECT_NEAR(right.expected[0].off, 0.01, 1e-9);
  EXPECT_DOUBLE_EQ(right.expected[0].found, p);
  const Results wrong = judged({figure("contact.0.pressure.max", p / 1.01, 0.0099)});
  EXPECT_EQ(wrong.status, Status::check_failed);
  EXPECT_EQ(wrong.checks.back().name, "contact.0.pressure.max as expected");
  EXPECT_EQ(judged({figure("contact.0.pressure.max", -p, 0.5)}).status, Status::check_failed);
}

TEST(Expected, FiguresOfProbesAreThoseOfTheirRow) {
  Scene scene = read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/patch_flat.toml");
  scene.probes = {{.key = "probe.0", .at = {{0.3, 0.2}, {0.3, 0.4}}}};
  Results r = solve_scene(scene);
  const ProbeValue& second = r.recovery.probes[1];
  r.problem.expectations = {figure("probe.1.u_y", second.u.y(), 1e-12),
                            figure("probe.1.sigma_22", second.stress(1), 1e-12),
                            figure("probe.0.u_y", second.u.y(), 1e-12), figure("probe.2.u_y", second.u.y(), 1)};
  judge_expectations(r);
  for (const int k : {0, 1, 2, 3}) EXPECT_EQ(r.checks[r.checks.size() - 4 + k].ok(), k < 2) << k;
}

TEST(Expected, AFigureThatIsNotThereDoesNotHold) {
  for (const char* name : {"contact.7.pressure.max", "contact.0.pressure", "title", "contact.x", "~",
                           "contact.99999999999999999999.length"}) {
    const Results r = judged({figure(name, 1, 0.99)});
    EXPECT_EQ(r.status, Status::check_failed) << name;
    EXPECT_NE(r.checks.back().where.find("expected a dotted key"), std::string::npos) << name;
  }
}

TEST(Expected, PressuresHoldAtEveryNode) {
  const double p = largest_pressure();
  EXPECT_EQ(judged({pressure(p, 1e-6)}).status, Status::solved);
  EXPECT_EQ(judged({pressure(p, 1e-6)}, false).status, Status::solved);
  const Field step(std::to_string(p) + " * (1 + 0.02 * (s > 0.4))", {.key = "expect.0.pressure", .on_curve = true});
  const Results r = judged({pressure(step, 0.019)});
  EXPECT_EQ(r.status, Status::check_failed);
  EXPECT_NEAR(r.expected[0].off, 0.02 / 1.02, 1e-6);
  EXPECT_EQ(judged({pressure(step, 0.0197)}).status, Status::solved);
}

TEST(Expected, APressureThatIsNoNumberDoesNotHold) {
  for (const std::size_t node : {0u, 3u}) {
    Results r = judged({});
    r.problem.expectations = {pressure(largest_pressure(), 0.5)};
    r.recovery.contacts[0].multiplier.nodes[node].p = std::nan("");
    judge_expectations(r);
    EXPECT_FALSE(r.checks.back().ok()) << node;
  }
}

TEST(Expected, APressureWithoutAValueOrPairDoesNotHold) {
  const Field root("sqrt(x - 1e6)", {.key = "expect.0.pressure", .on_curve = true});
  EXPECT_EQ(judged({pressure(root, 0.9)}).status, Status::check_failed);
  const Results r = judged({pressure(1, 0.9, 3)});
  EXPECT_EQ(r.status, Status::check_failed);
  EXPECT_NE(r.checks.back().where.find("the scene has 1 pairs"), std::string::npos);
}

TEST(Expected, CostsALineEachAndElseNothing) {
  const Json without = report_of(judged({}));
  EXPECT_FALSE(without.contains("expected"));
  EXPECT_EQ(report_text(without, "out").find("expected"), std::string::npos);
  const Json with = report_of(judged({figure("energy", without["energy"], 0.01)}));
  EXPECT_EQ(with["expected"][0]["source"], "statics");
  EXPECT_NE(report_text(with, "out").find("  expected  energy"), std::string::npos);
  EXPECT_EQ(with["checks"].size(), without["checks"].size() + 1);
}

}  // namespace
}  // namespace mortise::test
