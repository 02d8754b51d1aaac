// The scenes of geo/ as a user runs them: real .toml, real gmsh.
#include <gtest/gtest.h>

#include <cmath>

#include "app/solve_scene.hpp"

namespace mortise::test {
namespace {

Results solved_scene(const std::string& name, std::vector<Override> overrides = {}) {
  return solve_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/" + name + ".toml", overrides));
}

class Scenes : public testing::TestWithParam<const char*> {};

TEST_P(Scenes, EveryCheckHoldsOnBothMultiplierSides) {
  const Scene scene = read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/" + GetParam() + ".toml");
  for (std::size_t side = 0; side < 2; ++side) {
    Scene s = scene;
    for (ContactSpec& contact : s.contacts) contact.multipliers_on = contact.between[side];
    const Results r = solve_scene(s);
    EXPECT_EQ(r.status, Status::solved);
    for (const Check& c : r.checks) EXPECT_TRUE(c.ok()) << c.name << ": " << c.value << " above " << c.limit;
    EXPECT_EQ(r.recovery.contacts.size(), scene.contacts.size());
  }
}

INSTANTIATE_TEST_SUITE_P(All, Scenes,
                         testing::Values("patch_flat", "patch_inclined", "stack", "tent_a", "tent_b", "tent_c",
                                         "circle", "parabola_1", "parabola_2", "cosine", "rings", "shrink_fit",
                                         "gap_close", "lift_off", "punch"),
                         [](const auto& name) { return std::string(name.param); });

// Plane strain, thick ring a < r < b under pressure p inside and q outside, free strain e (Lame):
// u(r) = (1 + nu)/E ((1 - 2 nu) A r + B / r) + (1 + nu) e r, A = (p a^2 - q b^2)/(b^2 - a^2), B = (p - q) a^2 b^2/(b^2
// - a^2).
struct Ring {
  double a, b, young, poisson, strain;
  double displacement(double r, double p, double q) const {
    const double d = b * b - a * a, A = (p * a * a - q * b * b) / d, B = (p - q) * a * a * b * b / d;
    return (1 + poisson) / young * ((1 - 2 * poisson) * A * r + B / r) + (1 + poisson) * strain * r;
  }
};

// The pressure at which both rings have the same displacement at r = 2; it is linear in the pressure.
double lame_pressure(const Ring& inner, const Ring& outer, double inside, double outside) {
  const auto jump = [&](double p) { return outer.displacement(2, p, outside) - inner.displacement(2, inside, p); };
  return -jump(0) / (jump(1e6) - jump(0)) * 1e6;
}

// L2 error of p over the arc, relative to the exact constant: Simpson's rule on each quadratic edge.
double pressure_error(const Results& r, double exact) {
  const auto& nodes = r.recovery.contacts[0].multiplier.nodes;
  double sum = 0, length = 0;
  for (std::size_t i = 0; i + 2 < nodes.size(); i += 2) {
    const double width = nodes[i + 2].s - nodes[i].s;
    for (std::size_t k = 0; k < 3; ++k) sum += width * (k == 1 ? 4 : 1) / 6 * std::pow(nodes[i + k].p - exact, 2);
    length += width;
  }
  return std::sqrt(sum / length) / exact;
}

// Errors of p on four meshes, 3 : 4 along the arc.
std::array<double, 4> lame_study(const std::string& scene, double exact, const std::string& side,
                                 const std::string& space) {
  std::array<double, 4> errors{};
  for (int level = 0; level < 4; ++level) {
    const Results r = solved_scene(scene, {{"mesh.parameters.n_inner", std::to_string(12 << level)},
                                           {"mesh.parameters.n_outer", std::to_string(16 << level)},
                                           {"contact.multipliers_on", side},
                                           {"method.multipliers", space}});
    errors[level] = pressure_error(r, exact);
    EXPECT_EQ(r.status, Status::solved);
  }
  std::printf("%s, %s on %s: p error %.2e %.2e %.2e %.2e\n", scene.c_str(), space.c_str(), side.c_str(), errors[0],
              errors[1], errors[2], errors[3]);
  return errors;
}

// All errors lie below 1.5 times the h^2 line through the first.
void expect_second_order(const std::array<double, 4>& errors) {
  for (std::size_t k = 1; k < 4; ++k) EXPECT_LE(errors[k] * std::pow(4, k), 1.5 * errors[0]) << "mesh " << k;
}

void expect_lame(const std::string& scene, double exact, double finest) {
  for (const char* side : {"inner_contact", "outer_contact"}) {  // the default space
    const auto linear = lame_study(scene, exact, side, "linear");
    expect_second_order(linear);
    EXPECT_LE(linear[3], finest / 100);
  }
  for (const char* space : {"quadratic", "dual"}) {
    const auto fine = lame_study(scene, exact, "outer_contact", space);
    expect_second_order(fine);
    EXPECT_LE(fine[3], finest);
    // On the coarser side the error is far smaller from the first mesh on, and falls more slowly.
    const auto coarse = lame_study(scene, exact, "inner_contact", space);
    EXPECT_GE(std::log2(coarse[2] / coarse[3]), 1.5) << space;
    EXPECT_LE(coarse[3], 0.2 * fine[3]);
  }
}

TEST(Lame, RingsUnderPressure) {
  const Ring inner{1, 2, 210e9, 0.3, 0}, outer{2, 3, 70e9, 0.3, 0};
  expect_lame("rings", lame_pressure(inner, outer, 10e6, 4e6), 1e-5);
}

TEST(Lame, ShrinkFit) {
  const Ring inner{1, 2, 210e9, 0.3, 0}, outer{2, 3, 70e9, 0.3, 12e-6 * -100};
  expect_lame("shrink_fit", lame_pressure(inner, outer, 0, 0), 6e-5);
}

TEST(Lame, DisplacementsOfTheShrinkFit) {
  const Ring inner{1, 2, 210e9, 0.3, 0}, outer{2, 3, 70e9, 0.3, 12e-6 * -100};
  const double p = lame_pressure(inner, outer, 0, 0);
  const Results r = solved_scene("shrink_fit", {{"mesh.parameters.n_inner", "24"}, {"mesh.parameters.n_outer", "32"}});
  double worst = 0, largest = 0;
  for (std::size_t b = 0; b < 2; ++b)
    for (int i = r.problem.points.first[b]; i < r.problem.points.first[b + 1]; ++i) {
      const int node = r.problem.points.node[i];
      const Vec2 x = r.problem.mesh.nodes.row(node).transpose();
      const double radius = x.norm();
      const double exact =
          r.problem.mesh.bodies[b] == "inner" ? inner.displacement(radius, 0, p) : outer.displacement(radius, p, 0);
      worst = std::max(worst, (r.solution.u.segment<2>(2 * node) - exact * x / radius).norm());
      largest = std::max(largest, std::abs(exact));
    }
  EXPECT_LE(worst, 1e-4 * largest);
}

TEST(Default, MultipliersLieOnTheFinerSide) {
  const Results fine_below = solved_scene("patch_flat"),
                fine_above = solved_scene("patch_flat", {{"mesh.parameters.n_upper", "13"}});
  EXPECT_EQ(fine_below.problem.pairs[0].spec.multipliers_on, "lower_contact");
  EXPECT_EQ(fine_above.problem.pairs[0].spec.multipliers_on, "upper_contact");
}

TEST(Default, LinearMultipliersDoNotOscillateWhereQuadraticOnesDo) {
  // The cosine held together where it would part, along the edges' normals: quadratic multipliers swing by the size of
  // the pressure itself.
  const auto swing = [](const Results& r) {  // mean |second difference| of p over mean |p|
    const auto& n = r.recovery.contacts[0].multiplier.nodes;
    double sum = 0, size = 0;
    for (std::size_t i = 2; i + 2 < n.size(); i += 1) {
      sum += std::abs(n[i - 1].p - 2 * n[i].p + n[i + 1].p);
      size += std::abs(n[i].p);
    }
    return sum / size;
  };
  const Override held{"contact.condition", "bilateral"};
  const Override edges{"method.normals", "edges"}, quadratic{"method.multipliers", "quadratic"};
  const double linear = swing(solved_scene("cosine", {held, edges}));
  EXPECT_LT(linear, 0.05);
  EXPECT_GT(swing(solved_scene("cosine", {held, edges, quadratic})), 5 * linear);
  EXPECT_LT(swing(solved_scene("cosine", {held, quadratic})), 3 * linear);  // along the curve's
}

}  // namespace
}  // namespace mortise::test
