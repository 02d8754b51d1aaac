// Displacements and stresses at places, against exact fields.
#include "results/probes.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <random>

#include "app/solve_scene.hpp"
#include "error/goal_estimate.hpp"
#include "fem/quadrature.hpp"
#include "support/messages.hpp"
#include "support/patches.hpp"
#include "support/plate_scenes.hpp"

namespace mortise::test {
namespace {

ProbeSpec probe(std::vector<Vec2> at, const std::string& body = "", double angle = 0) {
  return {.key = "probe.0", .at = std::move(at), .body = body, .angle = angle};
}

double difference(const Vec4& a, const Vec4& b) { return (a - b).cwiseAbs().maxCoeff(); }

TEST(Probes, AreExactWhereTheStressIsUniform) {
  // sigma_22 = -10 MPa, sigma_33 = nu sigma_22, u_y = -(1 - nu^2)/E 10 MPa y.
  Scene s = uniaxial_scene();
  s.probes = {probe({{0.13, 0.05}, {0.61, 0.37}}), probe({{0.4, 0.3}}, "lower", 45), probe({{0.4, 0.3}}, "lower", 30)};
  const Results r = solve_scene(s, mesh_of({}));
  ASSERT_EQ(r.recovery.probes.size(), 4u);
  for (const int k : {0, 1}) {
    const ProbeValue& v = r.recovery.probes[k];
    EXPECT_LE(difference(v.stress, {0, -10e6, -3e6, 0}), 1);
    EXPECT_NEAR(v.u.y(), -(1 - 0.09) / 210e9 * 10e6 * v.place.x.y(), 1e-15);
    EXPECT_NEAR(v.von_mises, 10e6 * std::sqrt(1 - 0.3 + 0.09), 1);
    EXPECT_TRUE(std::isnan(v.place.s));
  }
  EXPECT_LE(difference(r.recovery.probes[2].stress, {-5e6, -5e6, -3e6, -5e6}), 1);
  const double half = std::sqrt(3) / 2;  // cos 30
  EXPECT_LE(difference(r.recovery.probes[3].stress, {-10e6 / 4, -10e6 * 3 / 4, -3e6, -10e6 * half / 2}), 1);
}

TEST(Probes, LeaveOutTheStrainOfAnExpansionThatNothingHinders) {
  Scene s = uniaxial_scene();
  s.boundaries.pop_back();
  for (const char* body : {"upper", "lower"})
    s.initial_strains.push_back({"initial_strain", body, {}, {Field(1e-3), Field(1e-3), Field(), Field()}});
  s.probes = {probe({{0.2, 0.1}})};
  const Results r = solve_scene(s, mesh_of({}));
  EXPECT_LE(difference(r.recovery.probes[0].stress, Vec4::Zero()), 1e-8 * 210e9 * 1e-3);
  EXPECT_NEAR(r.recovery.probes[0].u.x(), 2e-4, 1e-12);
}

// A quarter ring, 1 < r < 2, under pressure in its bore.
Results ring(int n, const std::vector<ProbeSpec>& probes, CellKind kind = CellKind::quad8) {
  Scene s = bored_scene();
  s.probes = probes;
  return solve_scene(s, mesh_of({test::ring("ring", 2 * n, n, {0, 0}, 1, 2, 90, 0)}, kind));
}

TEST(Probes, AlongARadiusOfLamesRingConvergeFasterThanTheElementsOwnStress) {
  // sigma_r, sigma_theta = p / 3 (1 -+ 4 / r^2), in axes along the radius at 35 degrees.
  constexpr double pressure = 10e6;
  ProbeSpec line = probe({}, "", 35);
  line.line = true;
  const double angle = 35 * std::numbers::pi / 180;
  const Vec2 radius(std::cos(angle), std::sin(angle));
  for (int i = 0; i <= 40; ++i) line.at.push_back((1 + i / 40.0) * radius);
  double before = 0;
  for (const int n : {4, 8, 16}) {
    const Results r = ring(n, {line});
    ASSERT_EQ(r.recovery.probes.size(), line.at.size());
    EXPECT_NEAR(r.recovery.probes.back().place.s, 1, 1e-12);
    double inside = 0, own_inside = 0, all = 0, spread = 0;
    for (const ProbeValue& v : r.recovery.probes) {
      const double at = v.place.x.norm(), q = 4 / (at * at);
      const Vec4 exact = pressure / 3 * Vec4(1 - q, 1 + q, 2 * 0.3, 0);
      const double error = difference(v.stress, exact);
      all = std::max(all, error);
      spread = std::max(spread, v.spread);
      if (at < 1 + 1.0 / n || at > 2 - 1.0 / n) continue;  // cells along the boundary
      const Vec4 own =
          stress_at(r.problem.mesh, r.problem.mesh.cells[v.place.in.cell], r.problem.discretisation.laws[0],
                    r.solution.u, cell_shape(CellKind::quad8, v.place.in.xi));
      inside = std::max(inside, error);
      own_inside = std::max(own_inside, difference(in_turned_axes(own, angle), exact));
    }
    EXPECT_LT(inside, own_inside / 4) << n;
    if (n > 4) EXPECT_LT(all, before / 6) << n;  // third order; the elements' own is second
    EXPECT_LT(all, 2 * spread) << n;
    before = all;
  }
  EXPECT_LE(before, 4e-3 * pressure);
}

TEST(Probes, HaveBarsWhereErrorsAreEstimated) {
  // Along radii at 35 degrees and along the cut, on which patches lie on one side; u_r = (1 + nu) / E (0.4 A r + B /
  // r).
  constexpr double pressure = 10e6, A = pressure / 3, B = 4 * A;
  std::vector<ProbeSpec> lines{probe({}, "", 35), probe({}, "", 0)};
  for (ProbeSpec& line : lines) {
    line.line = true;
    const double angle = line.angle * std::numbers::pi / 180;
    for (int i = 0; i <= 30; ++i) line.at.push_back((1 + i / 30.0) * Vec2(std::cos(angle), std::sin(angle)));
  }
  for (const int n : {4, 8, 16, 32}) {
    Results r = ring(n, lines);
    EXPECT_FALSE(r.recovery.probes[0].error);
    estimate(r);
    int held = 0, counted = 0;
    std::vector<double> ratios;
    for (const ProbeValue& v : r.recovery.probes) {
      const double at = v.place.x.norm(), q = 4 / (at * at);
      const Vec2 u = 1.3 / 210e9 * (0.4 * A + B / (at * at)) * v.place.x;
      const Vec4 off = v.stress - A * Vec4(1 - q, 1 + q, 2 * 0.3, 0);
      const auto count = [&](double error, double bar, double round_off) {
        if (std::abs(error) < round_off) return;
        ++counted;
        held += std::abs(error) <= bar;
        ratios.push_back(bar / std::abs(error));
      };
      for (int k = 0; k < 2; ++k) count(v.u(k) - u(k), v.error->u(k), 1e-13 * u.norm());
      for (int k = 0; k < 3; ++k) count(off(k < 2 ? k : 3), v.error->stress(k), 1e-10 * pressure);
    }
    EXPECT_GE(counted, 270) << n;  // of 310, 31 of which are u_y along the cut
    EXPECT_GE(held, 0.95 * counted) << n;
    std::ranges::nth_element(ratios, ratios.begin() + ratios.size() / 2);
    EXPECT_LT(ratios[ratios.size() / 2], 40) << n;
  }
}

// Places drawn at random among linear elements, whose own cell is much of what u is off by.
TEST(Probes, HaveBarsOfDisplacementsWithinACell) {
  constexpr double A = 10e6 / 3, B = 4 * A;
  std::mt19937 draw(71);
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<ProbeSpec> places;
  for (int i = 0; i < 150; ++i) {
    const double angle = std::numbers::pi / 2 * (0.02 + 0.96 * part(draw)), at = 1.05 + 0.9 * part(draw);
    places.push_back(probe({at * Vec2(std::cos(angle), std::sin(angle))}));
  }
  for (const int n : {4, 8, 16}) {
    Results r = ring(n, places, CellKind::quad4);
    estimate(r);
    double worst = 0;
    for (const ProbeValue& v : r.recovery.probes) {
      const Vec2 u = 1.3 / 210e9 * (0.4 * A + B / v.place.x.squaredNorm()) * v.place.x;
      worst = std::max(worst, ((v.u - u).cwiseAbs().array() / v.error->u.array()).maxCoeff());
    }
    EXPECT_LT(worst, 1) << n;
  }
}

// Where the elements' own stress crosses the recovered one both err: the bar is no less than the cell's own difference
// in the mean.
TEST(Probes, BarsOfStressesAreNoLessThanTheDifferenceOverTheirCell) {
  ProbeSpec line = probe({}, "", 0);
  line.line = true;
  for (int i = 0; i <= 40; ++i) line.at.push_back((1.2 + 0.6 * i / 40) * Vec2(std::cos(0.6), std::sin(0.6)));
  Results r = ring(6, {line});
  estimate(r);
  const Problem& problem = r.problem;
  const StressPatches patches = recover_patches(
      problem.mesh, problem.points, sample_stresses(problem.mesh, problem.discretisation.laws, r.solution.u));
  for (const ProbeValue& v : r.recovery.probes) {
    const int cell = v.place.in.cell;
    const CellRule rule = product_rule(problem.mesh.cells[cell].kind, 2);
    Eigen::Vector3d squares = Eigen::Vector3d::Zero();
    for (std::size_t q = 0; q < rule.points.size(); ++q)
      squares +=
          rule.weights[q] * stress_difference(problem, r.solution.u, patches, {cell, rule.points[q], 0}).cwiseAbs2();
    squares /= std::accumulate(rule.weights.begin(), rule.weights.end(), 0.0);
    EXPECT_GE((v.error->stress - error_safety * squares.cwiseSqrt()).minCoeff(), 0) << v.place.x.transpose();
  }
}

TEST(Probes, HaveNoBarOfAStressWithoutLimit) {
  // The punch's corner on the line of contact, and a place beside it.
  Scene s = uniaxial_scene();
  s.boundaries[0] = {.key = "boundary.0", .on = {"bottom"}, .what = Displacement{0, 0}};
  s.probes = {probe({{0, 0}, {0.1, 0.1}})};
  Results r = solve_scene(s, mesh_of({}));
  estimate(r);
  EXPECT_TRUE(r.recovery.probes[0].error->stress.hasNaN());
  EXPECT_FALSE(r.recovery.probes[0].error->u.hasNaN());
  EXPECT_FALSE(r.recovery.probes[1].error->stress.hasNaN());
}

TEST(Probes, HaveBarsInTurnedAxes) {
  // Turned by a right angle 11 and 22 change places; of more than eight places the bars are not smaller.
  ProbeSpec straight = probe({}, "", 0), turned = probe({}, "", 90), points = probe({}, "", 0);
  straight.line = turned.line = true;
  for (int i = 0; i <= 20; ++i) straight.at.emplace_back(1.05 + i / 25.0, 0.2);
  turned.at = straight.at;
  for (int i = 0; i <= 20; i += 4) points.at.push_back(straight.at[i]);
  Results r = ring(6, {straight, turned, points});
  estimate(r);
  for (int i = 0; i <= 20; ++i) {
    const Eigen::Vector3d a = r.recovery.probes[i].error->stress, b = r.recovery.probes[21 + i].error->stress;
    EXPECT_LE((a - Eigen::Vector3d(b(1), b(0), b(2))).norm(), 1e-6 * a.norm());
    if (i % 4 > 0) continue;
    const Eigen::Vector3d own = r.recovery.probes[42 + i / 4].error->stress;
    EXPECT_GE((a - 0.5 * own).minCoeff(), 0) << i;
    EXPECT_GE((2 * own - 0.5 * a).minCoeff(), 0) << i;
  }
}

TEST(Probes, OutsideOrInTwoBodiesAreRefused) {
  const auto refusal = [](const ProbeSpec& which) {
    Scene s = uniaxial_scene();
    s.probes = {which};
    return message_of([&] { solve_scene(s, mesh_of({})); });
  };
  EXPECT_EQ(refusal(probe({{0.1, 0.1}, {3, 0.1}})),
            "test scene: probe.0: (3, 0.1) lies in no body; expected a place in one");
  EXPECT_EQ(refusal(probe({{0.1, 0.1}}, "upper")),
            "test scene: probe.0: (0.1, 0.1) lies in no part of 'upper'; expected a place in one");
  expect_contains(refusal(probe({{0.4, 0.3}})), "lies in bodies 'upper' and 'lower'; expected body = one of them");
  expect_contains(refusal(probe({{0.4, 0.3}}, "uper")), "probe.0.body: ");
  expect_contains(refusal(probe({{0.4, 0.3}}, "uper")), "'upper'");
}

TEST(Probes, BesideAContactLineBelongToTheBodyThatHasThem) {
  Scene s = uniaxial_scene();
  s.probes = {probe({{0.4, 0.302}, {0.4, 0.298}})};
  const Results r = solve_scene(s, mesh_of({}));
  const auto body = [&](int k) {
    return r.problem.mesh.bodies[r.problem.mesh.cells[r.recovery.probes[k].place.in.cell].body];
  };
  EXPECT_EQ(body(0), "upper");
  EXPECT_EQ(body(1), "lower");
}

}  // namespace
}  // namespace mortise::test
