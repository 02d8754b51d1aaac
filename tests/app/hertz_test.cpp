// A cylinder on a block from scene to results, against Hertz' theory of two half planes (Johnson 1985, section 4.2).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/solve_scene.hpp"

namespace mortise::test {
namespace {

Results solved_hertz(const std::string& name, const std::vector<Override>& overrides) {
  return solve_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/" + name + ".toml", overrides));
}

struct Hertz {
  double a;   ///< half the width of the contact
  double p0;  ///< pressure in its middle
  double p(double x) const { return p0 * std::sqrt(std::max(0.0, 1 - x * x / (a * a))); }
};

/// `P`: force on the whole cylinder per thickness; 1 / E* = sum (1 - nu^2) / E, nu = 0.3.
Hertz theory(double P, double radius, double E_cylinder, double E_block) {
  const double E_star = 1 / (0.91 / E_cylinder + 0.91 / E_block);
  const double a = std::sqrt(4 * P * radius / (std::numbers::pi * E_star));
  return {a, 2 * P / (std::numbers::pi * a)};
}

/// p^2 = p0^2 - (p0 / a)^2 x^2 fitted to the nodes with x < `reach` by least squares.
Hertz fit(const ContactSide& side, double reach) {
  double n = 0, sx = 0, sxx = 0, sy = 0, sxy = 0;
  for (const ContactNode& node : side.nodes) {
    if (node.position.x() > reach) continue;
    const double x2 = node.position.x() * node.position.x(), y = node.p * node.p;
    n += 1, sx += x2, sxx += x2 * x2, sy += y, sxy += x2 * y;
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx), p0 = std::sqrt((sy - slope * sx) / n);
  return {p0 / std::sqrt(-slope), p0};
}

/// Largest difference of p from the theory at the nodes with x < `reach`, over p0.
double worst_within(const ContactSide& side, const Hertz& exact, double reach) {
  double worst = 0;
  for (const ContactNode& node : side.nodes)
    if (node.position.x() <= reach) worst = std::max(worst, std::abs(node.p - exact.p(node.position.x())));
  return worst / exact.p0;
}

const char* side_name(bool on_block) { return on_block ? "block_top" : "cylinder_foot"; }

std::vector<Override> mesh(int order, int kind, int n_upper, int n_lower, bool on_block) {
  return {{"mesh.parameters.order", std::to_string(order)},
          {"mesh.parameters.kind", std::to_string(kind)},
          {"mesh.parameters.n_upper", std::to_string(n_upper)},
          {"mesh.parameters.n_lower", std::to_string(n_lower)},
          {"contact.multipliers_on", side_name(on_block)}};
}

// ---- Equal materials: a / R = 0.01 ----

const double half_base = 0.01;  // which holds n_upper and n_lower elements

// The exact slope is infinite at the edge of contact, which lies anywhere in an element: p swings there, each element
// away from it by a third. So p is judged four elements away: up to 0.8 a with 20 elements, 0.9 a with 40.
void expect_theory(const Results& r, double pressure, int n_upper, int n_lower) {
  const Hertz exact = theory(2 * pressure, 1, 210e9, 210e9);
  const double h = half_base / std::min(n_upper, n_lower), reach = exact.a - 4 * h;
  EXPECT_EQ(r.status, Status::solved);
  EXPECT_LE(r.solution.steps.size(), 12u);
  const ContactResults& contact = r.recovery.contacts[0];
  EXPECT_NEAR(std::abs(contact.force.y()), pressure, 1e-6 * pressure);
  EXPECT_NEAR(contact.length_in_contact, exact.a, 1.5 * h);
  for (const ContactSide* side : {&contact.multiplier, &contact.opposite}) {
    const Hertz found = fit(*side, reach);
    EXPECT_NEAR(found.p0, exact.p0, 0.005 * exact.p0) << side->curve;
    EXPECT_NEAR(found.a, exact.a, 0.005 * exact.a) << side->curve;
    EXPECT_LE(worst_within(*side, exact, reach), 0.01) << side->curve;
  }
}

class Cylinder : public testing::TestWithParam<std::tuple<int, int, std::pair<int, int>, bool>> {};

// 3-node triangles have one stress each and need about 30 elements over the half width for what the others reach
// with 20.
TEST_P(Cylinder, AgreesWithHertz) {
  auto [order, kind, n, on_block] = GetParam();
  if (order == 1 && kind == 1) n = {n.first * 8 / 5, n.second * 8 / 5};
  expect_theory(solved_hertz("hertz", mesh(order, kind, n.first, n.second, on_block)), 4.6e6, n.first, n.second);
}

INSTANTIATE_TEST_SUITE_P(Meshes, Cylinder,
                         testing::Combine(testing::Values(1, 2), testing::Values(0, 1),
                                          testing::Values(std::pair(20, 20), std::pair(20, 25), std::pair(25, 20)),
                                          testing::Bool()));

TEST(CylinderOnABlock, AgreesWithHertzInEveryMultiplierSpace) {
  for (const char* space : {"quadratic", "dual"})
    for (const bool on_block : {false, true}) {
      SCOPED_TRACE(std::string(space) + " on " + side_name(on_block));
      auto overrides = mesh(2, 0, 20, 25, on_block);
      overrides.push_back({"method.multipliers", space});
      expect_theory(solved_hertz("hertz", overrides), 4.6e6, 20, 25);
    }
}

TEST(CylinderOnABlock, AgreesWithHertzWhereverTheEdgeLiesInAnElement) {
  for (const int order : {1, 2})
    for (int i = 0; i < 5; ++i) {
      const double a = half_base * (1 + 0.2 * i / 20), E_star = 210e9 / 1.82;
      const double pressure = std::numbers::pi * E_star * a * a / 8;
      SCOPED_TRACE("order " + std::to_string(order) + ", pressure " + std::to_string(pressure));
      auto overrides = mesh(order, 0, 20, 20, false);
      overrides.push_back({"boundary.2.pressure", std::to_string(pressure)});
      expect_theory(solved_hertz("hertz", overrides), pressure, 20, 20);
    }
}

TEST(CylinderOnABlock, AFinerMeshIsRightNearerToTheEdge) {
  for (const int order : {1, 2}) expect_theory(solved_hertz("hertz", mesh(order, 0, 40, 40, false)), 4.6e6, 40, 40);
}

// ---- NAFEMS (Konter 2006): a / R = 0.124 ----

TEST(CylinderOnABlock, NafemsIsWithinOnePercentOfHertz) {
  const Hertz exact = theory(35e3, 50, 210e3, 70e3);
  EXPECT_NEAR(exact.a, 6.21, 0.005);  // mm, as published
  EXPECT_NEAR(exact.p0, 3585, 0.5);   // MPa
  for (const bool on_block : {false, true})
    for (const int n_lower : {20, 25}) {
      SCOPED_TRACE(std::string(side_name(on_block)) + " 20:" + std::to_string(n_lower));
      const Results r = solved_hertz("hertz_nafems", mesh(2, 0, 20, n_lower, on_block));
      EXPECT_EQ(r.status, Status::solved);
      const Hertz found = fit(r.recovery.contacts[0].multiplier, 0.8 * exact.a);
      EXPECT_NEAR(found.p0, exact.p0, 0.01 * exact.p0);
      EXPECT_NEAR(found.a, exact.a, 0.01 * exact.a);
      EXPECT_LE(worst_within(r.recovery.contacts[0].multiplier, exact, 0.8 * exact.a), 0.01);
    }
}

TEST(CylinderOnABlock, NafemsInMetresAgreesWithMillimetres) {
  const Results mm = solved_hertz("hertz_nafems", {}),
                m = solved_hertz("hertz_nafems", {{"mesh.parameters.radius", "0.05"},
                                                  {"mesh.parameters.half_width", "6.2e-3"},
                                                  {"mesh.parameters.block_width", "0.1"},
                                                  {"mesh.parameters.block_height", "0.2"},
                                                  {"materials.steel.young", "210e9"},
                                                  {"materials.aluminium.young", "70e9"},
                                                  {"boundary.2.pressure", "350e6"}});
  // The limit is that of two runs of gmsh, which places the nodes along a curve by numerical integration.
  EXPECT_EQ(m.solution.active, mm.solution.active);
  EXPECT_LE((m.recovery.contacts[0].pressure - 1e6 * mm.recovery.contacts[0].pressure).cwiseAbs().maxCoeff(),
            1e-8 * m.recovery.contacts[0].p_max);
}

// Round-off is that of the softer body, whose contact it would be taken for.
TEST(Hertz, AStiffBodyOfAnyModulusHidesNoContact) {
  const auto length = [](const char* young) {
    const Results r = solve_scene(read_scene(
        MORTISE_SOURCE_DIR "/geo/hertz.toml",
        {{"materials.stiff", "{ young = " + std::string(young) + ", poisson = 0.3 }"}, {"bodies.block", "stiff"}}));
    EXPECT_EQ(r.status, Status::solved) << young;
    return r.recovery.contacts[0].length_in_contact;
  };
  const double rigid = length("210e14");
  EXPECT_GT(rigid, 1e-3);
  for (const char* young : {"210e16", "210e18", "210e21"}) EXPECT_NEAR(length(young), rigid, 1e-4 * rigid) << young;
}

}  // namespace
}  // namespace mortise::test
