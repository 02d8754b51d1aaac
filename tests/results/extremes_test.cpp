// The largest stresses and where they are, on exact fields.
#include "results/extremes.hpp"

#include <gtest/gtest.h>

#include "app/solve_scene.hpp"
#include "results/error_report.hpp"
#include "results/report.hpp"
#include "support/patches.hpp"
#include "support/plate_scenes.hpp"

namespace mortise::test {
namespace {

TEST(PrincipalStresses, AreThoseOfTheThreeDirections) {
  const auto expect = [](const Vec4& s, double smallest, double largest) {
    const PrincipalStresses found = principal_stresses(s);
    EXPECT_NEAR(found.smallest, smallest, 1e-14);
    EXPECT_NEAR(found.largest, largest, 1e-14);
  };
  expect({3, 1, 2, 0}, 1, 3);
  expect({0, 0, 0, 2}, -2, 2);
  expect({3, 3, 7, 0}, 3, 7);
  expect({4, 1, -1, 2}, -1, 5);  // (4 + 1) / 2 +- 5 / 2, and 33
}

TEST(Extremes, OfARingUnderPressureLieInItsBore) {
  // Lame: in the bore sigma_r = -p, sigma_theta = 5/3 p; von Mises' stress with sigma_33 = nu (sigma_r + sigma_theta).
  const Results r =
      solve_scene(bored_scene(), mesh_of({test::ring("ring", 32, 16, {0, 0}, 1, 2, 90, 0)}, CellKind::quad8));
  const Extremes& found = r.recovery.extremes;
  EXPECT_NEAR(found.principal_max.value, 5.0 / 3 * 10e6, 2e-3 * 10e6);
  EXPECT_NEAR(found.principal_min.value, -10e6, 5e-3 * 10e6);
  EXPECT_NEAR(found.von_mises.value, von_mises({-10e6, 5.0 / 3 * 10e6, 0.2 * 10e6, 0}), 5e-3 * 10e6);
  for (const Extreme* e : {&found.principal_max, &found.principal_min, &found.von_mises})
    EXPECT_NEAR(e->place.norm(), 1, 1e-12);
  EXPECT_FALSE(largest_pressure(r.recovery.contacts));
  EXPECT_FALSE(grows_without_limit(r, found.von_mises));
}

TEST(Extremes, NameTheBodyAndTheCornerWithoutLimit) {
  // Clamped all along one side and pulled: in plane strain the stress has no limit at the ends of the clamp.
  Scene s = steel_scene({"idle", "pulled"});
  s.boundaries = {{.key = "clamp", .on = {"pulled_west", "idle_west"}, .what = Displacement{0, 0}},
                  {.key = "load", .on = {"pulled_east"}, .what = SurfaceTraction{Vec2(10e6, 0)}}};
  const auto block = [](const std::string& name, double y) {
    return Patch{name, 8, 8, [=](double a, double b) { return Vec2(a, y + b); }};
  };
  const Results r = solve_scene(s, mesh_of({block("idle", 0), block("pulled", 2)}, CellKind::quad8));
  EXPECT_EQ(r.problem.mesh.bodies[r.recovery.extremes.von_mises.of], "pulled");
  EXPECT_NEAR(r.recovery.extremes.von_mises.place.x(), 0, 1e-12);
  EXPECT_TRUE(grows_without_limit(r, r.recovery.extremes.von_mises));
}

// At the end of a flat punch the block's own outline goes on straight: only the estimate knows the point.
TEST(Extremes, StressesAtTheEndsOfContactHaveNoLimit) {
  Results r = solve_scene(read_scene(MORTISE_SOURCE_DIR "/geo/punch.toml"));
  estimate(r);
  const PressureEstimate& e = r.estimate->pressures[0];
  ASSERT_FALSE(e.singular.empty());
  Extreme stress = r.recovery.extremes.von_mises;
  stress.node = r.recovery.contacts[0].multiplier.nodes[5].node;
  stress.place = e.singular[0].position;
  EXPECT_TRUE(grows_without_limit(r, stress));
  stress.place += Vec2(0.1, 0.1) * e.singular[0].edge;
  EXPECT_FALSE(grows_without_limit(r, stress));
}

TEST(Extremes, OfThePressureIsItsPlaceOnItsPair) {
  Results r = solve_scene(read_scene(MORTISE_SOURCE_DIR "/geo/hertz.toml"));
  const double of_multiplier = largest_pressure(r.recovery.contacts)->value;
  estimate(r);  // which reads p better than the multiplier does
  const Json summary = report_of(r), pressure = summary["extremes"]["pressure"];
  EXPECT_EQ(pressure["pair"], 0);
  EXPECT_EQ(pressure["value"], summary["contact"][0]["pressure"]["max"]);
  EXPECT_NE(pressure["value"], of_multiplier);
}

TEST(ContactMoments, AreOppositeToThoseOfTheLoadAbove) {
  const Results r = solve_scene(uniaxial_scene(), mesh_of({}));
  const ContactResults& c = r.recovery.contacts[0];
  const double sign = c.multiplier.curve == "upper_contact" ? -1 : 1;
  const Resultant& load = r.problem.discretisation.boundary_sums[2];
  EXPECT_NEAR(c.moment, sign * load.moment, 1e-9 * std::abs(load.moment));
  EXPECT_NEAR(c.moment - (c.centre.x() * c.force.y() - c.centre.y() * c.force.x()), 0, 1e-9 * std::abs(load.moment));
}

}  // namespace
}  // namespace mortise::test
