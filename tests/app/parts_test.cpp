// Parts with corners in contact, as they are drawn every day: right answers are called right, in few words.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/solve_scene.hpp"
#include "results/error_report.hpp"

namespace mortise::test {
namespace {

Results solved_part(const std::string& name, const std::string& parameter = "", const std::string& value = "") {
  std::vector<Override> overrides;
  if (!parameter.empty()) overrides.push_back({parameter, value});
  Results r = solve_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/tests/parts/" + name + ".toml", overrides));
  estimate(r);
  return r;
}

// Solved, with one note a pair at most, which names a place or a body. A mesh that is `coarse` does not resolve p, and
// says so.
void expect_few_words(const Results& r, bool coarse = false) {
  EXPECT_EQ(r.status, coarse ? Status::check_failed : Status::solved);
  for (const Check& check : r.checks)
    EXPECT_EQ(check.ok(), !(coarse && check.name == "estimated error of p")) << check.name << ": " << check.value;
  EXPECT_LE(r.warnings.size(), r.problem.pairs.size() + (coarse ? 1 : 0));
  for (const std::string& note : r.warnings)
    EXPECT_TRUE(note.find("near (") != std::string::npos || note.find("(x = ") != std::string::npos ||
                note.find("body '") != std::string::npos)
        << note;
}

void expect_force(const Vec2& force, const Vec2& exact) {
  EXPECT_LE((force - exact).norm(), 1e-8 * exact.norm()) << force.transpose();
}

Vec2 force_on(const Results& r, std::size_t pair, const std::string& curve) {
  const ContactResults& c = r.recovery.contacts[pair];
  return c.multiplier.curve == curve ? c.force : Vec2(-c.force);
}

class Refined : public testing::TestWithParam<int> {};

TEST_P(Refined, ABeamOnThreeSupports) {
  const Results r = solved_part("beam_on_supports", "mesh.parameters.n", std::to_string(GetParam()));
  expect_few_words(r);
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += force_on(r, k, "foot_" + std::to_string(k)).y();
  EXPECT_NEAR(sum, 1e6, 1e-3);  // 1 MPa on 1 m
}

INSTANTIATE_TEST_SUITE_P(Meshes, Refined, testing::Values(3, 4, 8, 12));

TEST(Parts, ADovetail) {
  const Results r = solved_part("dovetail");
  expect_few_words(r);
  const double pull = 20e6 * (0.05 - 0.04 / std::sqrt(3));  // the flank is at 60 degrees: its normal is at 30
  expect_force(force_on(r, 0, "tenon_flank"), {-pull * std::sqrt(3), -pull});
}

TEST(Parts, AShaftInAVBlock) {
  const Results r = solved_part("v_block");
  expect_few_words(r, true);
  const Vec2 weight = r.problem.discretisation.body_sums[0].force;
  EXPECT_NEAR(weight.y(), -2e8 * std::numbers::pi / 2 * 0.02 * 0.02, 1);
  expect_force(force_on(r, 0, "shaft_foot"), {weight.y(), -weight.y()});
}

TEST(Parts, ABlockInAnL) {
  const Results r = solved_part("block_in_l");
  expect_few_words(r);
  expect_force(force_on(r, 0, "block_sides"), {5e5, 1e6});
}

TEST(Parts, TwoStackedBlocksUnderTheirWeight) {
  const Results r = solved_part("stacked_blocks");
  expect_few_words(r);
  expect_force(force_on(r, 0, "upper_foot"), {0, 25e3});
  for (const ContactNode& n : r.recovery.contacts[0].multiplier.nodes) EXPECT_NEAR(n.p, 25e3, 1e-6 * 25e3);
}

TEST(Parts, TwoBondedMaterialsAreOneBodyForTheBalance) {
  const Results r = solved_part("bonded_pair");
  expect_few_words(r);
  expect_force(force_on(r, 0, "lining_foot"), {0, 10e6});
}

// ---- The estimated error of p ----

bool says_p_is_off(const Results& r) {
  return std::any_of(r.warnings.begin(), r.warnings.end(), [](const std::string& note) {
    return note.starts_with("the contact pressure may be off by") && note.find("near (") != std::string::npos;
  });
}

TEST(EstimatedError, ACoarseMeshIsNamedWithItsPlace) {
  const Results coarse = solved_part("v_block", "mesh.parameters.n", "6");
  EXPECT_EQ(coarse.status, Status::check_failed);  // by more than half
  EXPECT_GT(coarse.estimate->pressure(), pressure_error_limit);
  EXPECT_TRUE(says_p_is_off(coarse));
}

TEST(EstimatedError, DoesNotChangeWhereAllIsMovedAsAWhole) {
  const Results still = solved_part("v_block");
  const Results moved = solved_part("v_block", "boundary.1", "{on = \"ground\", displacement = { y = -0.009 }}");
  EXPECT_NEAR(moved.estimate->pressure(), still.estimate->pressure(), 1e-5);
}

TEST(EstimatedError, IsNoneWhereContactCarriesNothing) {
  const Results r = solved_part("v_block", "body_force.0.force", "[0, 0]");
  EXPECT_EQ(r.estimate->pressure_square(), 0);
  EXPECT_FALSE(says_p_is_off(r));
}

// A clearance of 0.1 % of the radius. Where the sides are straight the meshes' own gap is as large as the clearance.
Results pin(int n, int order, int straight, const std::vector<Override>& more = {}) {
  std::vector<Override> overrides{{"mesh.parameters.n", std::to_string(n)},
                                  {"mesh.parameters.order", std::to_string(order)},
                                  {"mesh.parameters.straight", std::to_string(straight)}};
  overrides.insert(overrides.end(), more.begin(), more.end());
  Results r = solve_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/tests/parts/pin_in_hole.toml", overrides));
  EXPECT_EQ(r.status, Status::solved);
  return r;
}

TEST(PinInAHole, ItsPressureIsRightOnStraightSides) {
  const Results curved = pin(60, 2, 0);
  const double peak = curved.recovery.contacts[0].p_max;
  for (const int n : {30, 60}) {
    EXPECT_NEAR(pin(n, 2, 1).recovery.contacts[0].p_max, peak, 0.01 * peak) << n;  // 6-node triangles
    EXPECT_NEAR(pin(n, 1, 0).recovery.contacts[0].p_max, peak, 0.03 * peak) << n;  // 3-node triangles
  }
  const Override meshes_gap{"contact.0.initial_gap", "measured"};
  EXPECT_GT(pin(30, 1, 0, {meshes_gap}).recovery.contacts[0].p_max, 1.5 * peak);

  const std::vector<ContactCentre> means = pin(60, 1, 0).recovery.contacts[0].multiplier.centres,
                                   expected = curved.recovery.contacts[0].multiplier.centres;
  ASSERT_EQ(means.size(), expected.size());
  for (std::size_t e = 0; e < means.size(); ++e) {
    ASSERT_LE((means[e].position - expected[e].position).norm(), 1e-3);
    if (expected[e].p > 0.1 * peak || expected[e].p == 0)  // not where contact ends
      EXPECT_NEAR(means[e].p, expected[e].p, 0.03 * peak) << e;
  }
}

}  // namespace
}  // namespace mortise::test
