// Reactions and sums of loads against statics, which leaves them no freedom.
#include "results/reactions.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "app/solve_scene.hpp"
#include "results/checks.hpp"
#include "support/patches.hpp"
#include "support/plate_scenes.hpp"
#include "support/wall.hpp"

namespace mortise::test {
namespace {

BoundarySpec held(std::vector<std::string> on, std::optional<double> x, std::optional<double> y) {
  return {.key = "support", .on = std::move(on), .what = Displacement{x, y}};
}

BoundarySpec pulled(const std::string& on, const Vec2& traction) {
  return {.key = "load", .on = {on}, .what = SurfaceTraction{traction}};
}

BoundarySpec pressed(const std::string& on, double pressure) {
  return {.key = "load", .on = {on}, .what = Pressure{pressure}};
}

// One body of steel, `young` in the units of stress.
Scene one_body(const std::string& name, double young = 210e9) {
  Scene s;
  s.path = "test scene";
  s.materials["steel"] = {young, 0.3, 0};
  s.bodies = {{name, "steel"}};
  return s;
}

Mesh beam(double length, double height, CellKind kind = CellKind::quad8, const Vec2& corner = Vec2::Zero()) {
  return mesh_of({{"beam", 12, 3, [=](double x, double y) { return Vec2(corner + Vec2(length * x, height * y)); }}},
                 kind);
}

double check_of(const Results& r, const std::string& name) {
  const auto found = std::ranges::find(r.checks, name, &Check::name);
  return found == r.checks.end() ? std::nan("") : found->value;
}

void expect_close(const Vec2& found, const Vec2& expected) {
  EXPECT_LE((found - expected).norm(), 1e-10 * expected.norm()) << found.transpose() << " for " << expected.transpose();
}

TEST(Reactions, OfACantilever) {
  // Clamped at x = 0, pulled down by 5e3 a length at x = 2: F = 5e3 * 0.3, M = 2 F.
  Scene s = one_body("beam");
  s.boundaries = {held({"beam_west"}, 0, 0), pulled("beam_east", {0, -5e3})};
  for (const CellKind kind : {CellKind::quad4, CellKind::quad8}) {
    const Results r = solve_scene(s, beam(2, 0.3, kind));
    EXPECT_EQ(r.status, Status::solved);
    ASSERT_EQ(r.recovery.reactions.curves.size(), 1u);
    const Reaction& clamp = r.recovery.reactions.curves[0];
    expect_close(clamp.sum.force, {0, 1.5e3});
    expect_close(clamp.centre, {0, 0.15});
    EXPECT_NEAR(clamp.sum.moment, 3e3, 1e-7);
    EXPECT_NEAR(clamp.sum.moment_about(clamp.centre), 3e3, 1e-7);
    EXPECT_NEAR(clamp.sum.moment_about({2, 0}), 0, 1e-7);
    const Resultant& load = r.problem.discretisation.boundary_sums[1];
    expect_close(load.force, {0, -1.5e3});
    EXPECT_NEAR(load.moment, -3e3, 1e-9);
    expect_close(load.centre(), {2, 0.15});
    EXPECT_LE(check_of(r, balance_check), 1e-11);
  }
}

TEST(Reactions, CarryTheWeightOfABodyWithCurvedSides) {
  // A quarter disc of radius 2 without its inner one: area 3 pi / 4, centroid at 28 / (9 pi) from both axes. Gravity 7
  // per area; quadratic sides leave the area 1e-6 off, and the same in both sums.
  const Mesh mesh = mesh_of({test::ring("ring", 8, 4, {0, 0}, 1, 2, 90, 0)}, CellKind::quad8);
  Scene s = one_body("ring");
  s.boundaries = {held({"ring_east"}, 0, 0)};
  s.body_forces = {{"weight", "ring", Vec2(0, -7)}};
  const Results r = solve_scene(s, mesh);
  const Resultant &weight = r.problem.discretisation.body_sums[0], &support = r.recovery.reactions.curves[0].sum;
  EXPECT_NEAR(weight.force.y(), -7 * 3 * std::numbers::pi / 4, 1e-4);
  EXPECT_NEAR(weight.moment, -7 * 7.0 / 3, 1e-4);  // 28 / (9 pi) times 3 pi / 4
  EXPECT_NEAR(weight.centre().y(), 28 / (9 * std::numbers::pi), 1e-5);
  expect_close(support.force, -weight.force);
  EXPECT_NEAR(support.moment, -weight.moment, 1e-9);
  EXPECT_NEAR(r.recovery.reactions.loads.moment, weight.moment, 1e-12);
}

TEST(Reactions, OfARingUnderPressure) {
  // Lame: the cuts of a quarter ring under the pressure p in its bore, of radius a, carry p a each, wherever the hoop
  // stress is: statics. A polygon of quadratic edges has the same chord.
  const Mesh mesh = mesh_of({test::ring("ring", 8, 4, {0, 0}, 1, 2, 90, 0)}, CellKind::quad8);
  Scene s = one_body("ring");
  s.boundaries = {held({"ring_east"}, {}, 0), held({"ring_west"}, 0, {}), pressed("ring_south", 10e6)};
  const Results r = solve_scene(s, mesh);
  ASSERT_EQ(r.recovery.reactions.curves.size(), 2u);
  expect_close(r.recovery.reactions.entries[0].force, {0, -10e6});
  expect_close(r.recovery.reactions.entries[1].force, {-10e6, 0});
  // The hoop stress p a^2 / (b^2 - a^2) (1 + b^2 / r^2) times r, from a = 1 to b = 2: p (1/2 + 4/3 ln 2).
  EXPECT_NEAR(r.recovery.reactions.entries[0].moment, -10e6 * (0.5 + 4.0 / 3 * std::log(2)), 1e-4 * 10e6);
}

TEST(Reactions, AreTheSameInOtherUnits) {
  Scene metres = one_body("beam"), millimetres = one_body("beam", 210e3);
  metres.boundaries = {held({"beam_west"}, 0, 0), pulled("beam_east", {2e6, -5e6})};
  millimetres.boundaries = {held({"beam_west"}, 0, 0), pulled("beam_east", {2, -5})};
  const Results a = solve_scene(metres, beam(2, 0.3)), b = solve_scene(millimetres, beam(2000, 300));
  const Resultant &in_m = a.recovery.reactions.all, &in_mm = b.recovery.reactions.all;
  expect_close(1e-3 * in_m.force, in_mm.force);  // N/m is 1e-3 N/mm
  EXPECT_NEAR(in_m.moment, in_mm.moment, 1e-9 * std::abs(in_mm.moment));
  EXPECT_LE(check_of(b, balance_check), 1e-11);
}

TEST(Reactions, OfANodeOnTwoSupportsCountForTheFirst) {
  Scene s = one_body("beam");
  s.boundaries = {held({"beam_west"}, 0, {}), held({"beam_south"}, 0, 0), pulled("beam_east", {4e6, 1e6}),
                  pulled("beam_north", {1e6, -1e6})};
  const Results one = solve_scene(s, beam(2, 0.3));
  std::swap(s.boundaries[0], s.boundaries[1]);
  const Results other = solve_scene(s, beam(2, 0.3));
  for (const Results& r : {one, other}) {
    expect_close(r.recovery.reactions.entries[0].force + r.recovery.reactions.entries[1].force,
                 r.recovery.reactions.all.force);
    expect_close(r.recovery.reactions.all.force, {-4e6 * 0.3 - 2e6, -1e6 * 0.3 + 2e6});
  }
  const Eigen::Index corner = 0;  // of both supports, held along x by either
  ASSERT_LE(one.problem.mesh.nodes.row(corner).norm(), 1e-15);
  const double shared = one.recovery.reactions.nodal(2 * corner);
  ASSERT_GT(std::abs(shared), 1e3);
  EXPECT_NEAR(one.recovery.reactions.entries[0].force.x() - shared, other.recovery.reactions.entries[1].force.x(),
              1e-6 * 4e6);
}

TEST(Reactions, OfEveryCurveAndLoadAddUpWhereBodiesAreInContact) {
  const Wall w = wall(4);
  const Results r = solve_scene(w.scene, w.mesh);
  Resultant curves, loads;
  for (const Reaction& reaction : r.recovery.reactions.curves) curves += reaction.sum;
  for (const Resultant& sum : r.problem.discretisation.boundary_sums) loads += sum;
  ASSERT_GT(loads.force.norm(), 1e5);
  expect_close(curves.force, -loads.force);
  EXPECT_NEAR(curves.moment, -loads.moment, 1e-9 * loads.arms);
  expect_close(r.recovery.reactions.loads.force, loads.force);
  EXPECT_NEAR(r.recovery.reactions.loads.moment, loads.moment, 1e-12 * loads.arms);
}

TEST(Reactions, FarFromTheOriginAreInBalance) {
  Scene s = one_body("beam");
  s.boundaries = {held({"beam_west"}, 0, 0), pulled("beam_east", {0, -5e3})};
  const Results r = solve_scene(s, beam(2, 0.3, CellKind::quad8, {1e6, -1e6}));
  // Coordinates are round-off of 1e6: 4e-10 of the loaded side.
  EXPECT_LE((r.recovery.reactions.all.force - Vec2(0, 1.5e3)).norm(), 1e-9 * 1.5e3);
  EXPECT_LE(check_of(r, balance_check), 1e-10);
}

TEST(Reactions, ThatAreNotThoseOfTheLoadFailTheSum) {
  const Scene s = clamped_scene();
  Results r = solve_scene(s, mesh_of({}));
  EXPECT_LE(check_of(r, balance_check), 1e-12);
  const double load = r.recovery.reactions.loads.force.norm();
  const Eigen::Index held = std::ranges::find(r.problem.discretisation.system.constraints.fixed, 1) -
                            r.problem.discretisation.system.constraints.fixed.begin();
  for (const double spoilt : {r.recovery.reactions.nodal(held) + 1e-6 * load, std::nan("")}) {
    r.recovery.reactions.nodal(held) = spoilt;
    r.checks = checks(r);
    EXPECT_FALSE(check_of(r, balance_check) <= 1e-10);
    EXPECT_NE(verdict(r), Status::solved);
  }
}

}  // namespace
}  // namespace mortise::test
