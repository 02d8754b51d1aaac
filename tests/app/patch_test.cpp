// Patch tests: a uniform stress passes through every non-matching contact line to round-off (exact).
#include <gtest/gtest.h>

#include "app/solve_scene.hpp"
#include "support/plate_scenes.hpp"

namespace mortise::test {
namespace {

// Largest relative error of p on both curves and of all stresses at nodes and centres. `stress` is exact.
double patch_error(const Results& r, const Vec4& stress) {
  const double size = stress.cwiseAbs().maxCoeff();
  double worst = 0;
  for (const auto* field : {&r.recovery.stress.points, &r.recovery.stress.centres})
    worst = std::max(worst, (field->rowwise() - stress.transpose()).cwiseAbs().maxCoeff() / size);
  for (const ContactResults& c : r.recovery.contacts)
    for (const ContactSide* side : {&c.multiplier, &c.opposite})
      for (const ContactNode& n : side->nodes) {
        const Vec4& s = stress;
        const Vec2 traction(s(0) * n.normal.x() + s(3) * n.normal.y(), s(3) * n.normal.x() + s(1) * n.normal.y());
        worst = std::max(worst, std::abs(n.p + traction.dot(n.normal)) / size);
      }
  return worst;
}

class Patch : public testing::TestWithParam<std::tuple<std::pair<CellKind, CellKind>, Multipliers, bool, bool>> {};

TEST_P(Patch, FlatAndInclined) {
  const auto [kinds, multipliers, on_lower, swapped] = GetParam();
  for (const bool inclined : {false, true}) {
    TwoPlates plates;
    if (inclined) plates.height = [](double x) { return 0.25 + x / 8; };
    plates.n_upper = swapped ? 11 : 7;
    plates.n_lower = swapped ? 7 : 11;
    plates.kind_upper = kinds.first;
    plates.kind_lower = kinds.second;
    Scene scene = inclined ? hydrostatic_scene() : uniaxial_scene();
    scene.method.multipliers = multipliers;
    scene.contacts[0].multipliers_on = on_lower ? "lower_contact" : "upper_contact";
    const Results r = solve_scene(scene, mesh_of(plates));
    EXPECT_EQ(r.status, Status::solved);
    // Plane strain: sigma_33 = nu (sigma_11 + sigma_22).
    const Vec4 exact = inclined ? Vec4(-10e6, -10e6, -6e6, 0) : Vec4(0, -10e6, -3e6, 0);
    EXPECT_LE(patch_error(r, exact), 1e-10);
  }
}

using Pair = std::pair<CellKind, CellKind>;
INSTANTIATE_TEST_SUITE_P(
    AllElements, Patch,
    testing::Combine(testing::Values(Pair{CellKind::quad8, CellKind::quad8}, Pair{CellKind::quad9, CellKind::tri6},
                                     Pair{CellKind::tri6, CellKind::quad8}, Pair{CellKind::quad4, CellKind::tri3},
                                     Pair{CellKind::tri3, CellKind::quad4}, Pair{CellKind::quad8, CellKind::quad4},
                                     Pair{CellKind::tri3, CellKind::tri6}),
                     testing::Values(Multipliers::quadratic, Multipliers::linear, Multipliers::dual), testing::Bool(),
                     testing::Bool()));

TEST(PatchElements, WithoutCuttingTheTestFails) {
  // What `integration = "elements"` costs: a few percent, whatever the mesh (docs/theory.md, coupling).
  Scene scene = uniaxial_scene();
  scene.method.integration = Integration::elements;
  const Results r = solve_scene(scene, mesh_of({}));
  const double error = patch_error(r, Vec4(0, -10e6, -3e6, 0));
  EXPECT_GT(error, 1e-3);
  EXPECT_LT(error, 0.5);
}

TEST(Units, MetresAndPascalsAgreeWithMillimetresAndMegapascals) {
  TwoPlates plates;
  plates.height = [](double x) { return -1.25 * x * x + x + 0.2; };
  plates.n_upper = 20;
  plates.n_lower = 25;
  Mesh metres = mesh_of(plates), millimetres = metres;
  millimetres.nodes *= 1000;
  Scene pascals = clamped_scene(), megapascals = pascals;
  megapascals.materials["steel"].young *= 1e-6;
  megapascals.boundaries.back().what = Pressure{10};
  const Results a = solve_scene(pascals, metres), b = solve_scene(megapascals, millimetres);
  EXPECT_LE((a.solution.u - b.solution.u / 1000).cwiseAbs().maxCoeff(), 1e-9 * a.solution.u.cwiseAbs().maxCoeff());
  EXPECT_LE((a.recovery.stress.points - 1e6 * b.recovery.stress.points).cwiseAbs().maxCoeff(),
            1e-9 * a.recovery.stress.points.cwiseAbs().maxCoeff());
  EXPECT_LE((a.recovery.contacts[0].pressure - 1e6 * b.recovery.contacts[0].pressure).cwiseAbs().maxCoeff(),
            1e-9 * a.recovery.contacts[0].p_max);
  EXPECT_NEAR(a.recovery.energy, b.recovery.energy, 1e-9 * a.recovery.energy);  // Pa m^2 = MPa mm^2
}

TEST(Energy, EqualsHalfTheWorkOfTheLoadOnASupportedBody) {
  const Results r = solve_scene(uniaxial_scene(), mesh_of({}));
  EXPECT_NEAR(r.recovery.energy, 0.5 * r.solution.u.dot(r.problem.discretisation.system.f), 1e-10 * r.recovery.energy);
  // Uniaxial plane strain: sigma^2 (1 - nu^2) / (2 E) times the area.
  EXPECT_NEAR(r.recovery.energy, 1e14 * 0.91 / (2 * 210e9) * 0.48, 1e-8 * r.recovery.energy);
}

}  // namespace
}  // namespace mortise::test
