// p* of whole scenes: nearer to what is known than the multiplier, in balance with it, within its bars.
#include "error/equal_moments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/solve_scene.hpp"
#include "fem/quadrature.hpp"

namespace mortise::test {
namespace {

Results estimated(const std::string& name, const std::vector<Override>& overrides) {
  Results r = solve_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/" + name + ".toml", overrides));
  estimate(r);
  return r;
}

// Of p or p_multiplier over the length in contact, straight along x.
struct Sums {
  double p = 0, moment = 0;
};

// By Gauss points that are dense enough for the root at the border, within 1e-5.
Sums sums_of(const Results& r, bool star) {
  const LineRule rule = gauss_legendre(60);
  const PressureLine& line = r.estimate->pressures[0].line;
  const EqualMoments& found = r.estimate->recovered[0];
  Sums sums;
  for (Eigen::Index e = 0; e + 1 < line.p.size(); ++e)
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      const double t = (1 + rule.points[i]) / 2, h = line.s(e + 1) - line.s(e);
      const double hats = (1 - t) * line.p(e) + t * line.p(e + 1);
      const double f = h / 2 * rule.weights[i] * (star ? found.at(e, t).value_or(hats) : hats);
      sums.p += f;
      sums.moment += f * (line.s(e) + t * h);
    }
  return sums;
}

// Hertz, half planes (Johnson 1985, section 4.2): a = 0.010048 m and p0 = 5.829e8 Pa of 2 x 4.6e6 N/m.
TEST(EqualMoments, OfACylinderAreNearerToHertz) {
  const Results r = estimated("hertz", {{"mesh.parameters.n_upper", "20"}, {"mesh.parameters.n_lower", "25"}});
  const double star = 210e9 / (2 * 0.91), force = 9.2e6;
  const double a = std::sqrt(4 * force / (std::numbers::pi * star)), p0 = 2 * force / (std::numbers::pi * a);
  double of_p = 0, of_multiplier = 0;
  for (const ContactNode& n : r.recovery.contacts[0].multiplier.nodes) {
    const double x = n.position.x() / a, exact = x < 1 ? p0 * std::sqrt(1 - x * x) : 0;
    of_p += (n.p - exact) * (n.p - exact);
    of_multiplier += (n.p_multiplier - exact) * (n.p_multiplier - exact);
    EXPECT_LE(std::abs(n.p - exact), n.p_error + 2e-3 * p0) << x;
  }
  EXPECT_LT(of_p, 0.2 * of_multiplier);
  ASSERT_EQ(r.estimate->recovered[0].borders.size(), 1u);
  const BorderPlace& border = r.estimate->recovered[0].borders[0];
  EXPECT_LE(std::abs(border.position.x() - a), border.bar);
  EXPECT_NEAR(r.recovery.contacts[0].length_in_contact, border.position.x(), 1e-3 * a);
}

TEST(EqualMoments, KeepForceAndMoment) {
  const Results r = estimated("parabola_1", {{"mesh.parameters.n_upper", "16"}, {"mesh.parameters.n_lower", "20"}});
  ASSERT_EQ(r.estimate->recovered[0].forms.size(), 1u);
  const Sums hats = sums_of(r, false), star = sums_of(r, true);
  // What 60 points miss of the powers at both ends, r^-0.58.
  EXPECT_NEAR(star.p / hats.p, 1, 0.02);
  EXPECT_NEAR(star.moment / star.p, hats.moment / hats.p, 1e-3 * hats.moment / hats.p);
}

TEST(EqualMoments, BarsAreNeverAboveTheMultipliers) {
  for (const char* name : {"parabola_1", "tent_b", "rings", "lift_off"}) {
    const Results r = estimated(name, {});
    for (std::size_t k = 0; k < r.problem.pairs.size(); ++k)
      EXPECT_LE((r.estimate->recovered[k].bar - r.estimate->pressures[k].bar).maxCoeff(), 0) << name;
  }
}

// A closed line that is loaded all round has neither ends nor borders: p* is the same from whatever vertex it starts.
TEST(EqualMoments, OfRingsAreTheExactPressureAllRound) {
  const Results r = estimated("rings", {});
  for (const ContactNode& n : r.recovery.contacts[0].multiplier.nodes)
    EXPECT_LE(std::abs(n.p - 4830258.30258), n.p_error) << n.s;
}

TEST(EqualMoments, AreNotThereWithoutAnEstimate) {
  const Results r = solve_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/parabola_1.toml", {}));
  for (const ContactNode& n : r.recovery.contacts[0].multiplier.nodes) EXPECT_EQ(n.p, n.p_multiplier);
}

}  // namespace
}  // namespace mortise::test
