// Contact that gives way, p = k times the overlap, from scene to results: exact answers.
#include <gtest/gtest.h>

#include <cmath>

#include "app/solve_scene.hpp"
#include "support/messages.hpp"

namespace mortise::test {
namespace {

Scene rough_scene(const std::string& name, const std::vector<Override>& overrides) {
  return read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/" + name + ".toml", overrides);
}

// ---- Uniaxial strain: three springs in a row ----

class GivingWay : public testing::TestWithParam<std::tuple<double, const char*, const char*, const char*>> {};

TEST_P(GivingWay, IsExactInUniaxialStrain) {
  const auto [down, space, side, solver] = GetParam();
  const Results r =
      solve_scene(rough_scene("gap_close", {{"boundary.2.displacement", "{y=" + std::to_string(-down) + "e-4}"},
                                            {"contact.0.stiffness", "2e12"},
                                            {"method.multipliers", space},
                                            {"contact.multipliers_on", side},
                                            {"method.solver", solver}}));
  const double gap = 1e-4, d = down * 1e-4, M_upper = 210e9 * 0.7 / (1.3 * 0.4), M_lower = M_upper / 3;
  const double p = std::max(0.0, (d - gap) / (0.3 / M_upper + 0.3 / M_lower + 1 / 2e12));
  EXPECT_EQ(r.status, Status::solved);
  for (const ContactNode& n : r.recovery.contacts[0].multiplier.nodes) {
    EXPECT_NEAR(n.p, p, 1e-8 * 47e6);
    EXPECT_NEAR(n.gap, p > 0 ? -p / 2e12 : gap - d, 1e-8 * d);
  }
}

INSTANTIATE_TEST_SUITE_P(BothSidesOfTouching, GivingWay,
                         testing::Combine(testing::Values(0.5, 1.000001, 3),
                                          testing::Values("linear", "quadratic", "dual"),
                                          testing::Values("upper_contact", "lower_contact"),
                                          testing::Values("direct", "feti")));

// ---- A rigid cylinder on a Winkler foundation (Johnson 1985, section 4.3) ----

TEST(ContactStiffness, RigidCylinderOnAFoundation) {
  const double k = 1.38e13, P = 9.2e6, R = 1, a = std::cbrt(1.5 * P * R / k);
  Results r = solve_scene(rough_scene("hertz", {{"contact.0.stiffness", "1.38e13"},
                                                {"materials.steel.young", "1e18"},
                                                {"mesh.parameters.n_upper", "40"},
                                                {"mesh.parameters.n_lower", "50"}}));
  estimate(r);
  const ContactResults& contact = r.recovery.contacts[0];
  EXPECT_EQ(r.status, Status::solved);
  for (const ContactNode& n : contact.multiplier.nodes) {
    const double x = n.position.x(), p = std::max(0.0, k / (2 * R) * (a * a - x * x));
    EXPECT_NEAR(n.p, p, n.p_error + 1e-4 * k * a * a / (2 * R)) << x;
    EXPECT_LT(n.p_error, 0.05 * k * a * a / (2 * R)) << x;
  }
}

TEST(ContactStiffness, CornersHaveAPressure) {
  Results hard = solve_scene(rough_scene("punch", {})),
          soft = solve_scene(rough_scene("punch", {{"contact.0.stiffness", "1e12"}}));
  estimate(hard);
  estimate(soft);
  EXPECT_FALSE(hard.estimate->pressures[0].singular.empty());
  EXPECT_TRUE(soft.estimate->pressures[0].singular.empty());
  EXPECT_EQ(soft.status, Status::solved);
}

TEST(ContactStiffness, GoesWithSolversThatHaveIt) {
  for (const char* solver : {"mssor", "ddm"})
    EXPECT_NE(message_of([&] {
                rough_scene("punch", {{"contact.0.stiffness", "1e12"}, {"method.solver", solver}});
              })
                  .find("does not solve contact that gives way, but contact.0 (line 32) has a stiffness; expected "
                        "\"direct\" or "
                        "\"feti\""),
              std::string::npos);
}

}  // namespace
}  // namespace mortise::test
