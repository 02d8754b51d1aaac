// Unilateral contact from scene to results: exact answers, complementarity, bodies that only contact holds.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/solve_scene.hpp"
#include "base/errors.hpp"
#include "fem/edges.hpp"
#include "results/warnings.hpp"
#include "support/messages.hpp"
#include "support/plate_scenes.hpp"

namespace mortise::test {
namespace {

Scene scene(const std::string& name, const std::vector<Override>& overrides = {}) {
  return read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/" + name + ".toml", overrides);
}

Results solved(const std::string& name, const std::vector<Override>& overrides = {}) {
  return solve_scene(scene(name, overrides));
}

double figure(const Results& r, const std::string& check) {
  for (const Check& c : r.checks)
    if (c.name == check) return c.value;
  ADD_FAILURE() << "no check " << check;
  return 0;
}

void expect_complementary(const Results& r) {
  EXPECT_NE(r.status, Status::not_converged);
  for (const char* check : {"p >= 0 at the multipliers", "weighted gap >= 0", "p gap = 0", "residual of the forces",
                            "force balance of each body", "contact forces equal and opposite"})
    EXPECT_LE(figure(r, check), 1e-9) << check;
}

const char* const spaces[] = {"linear", "quadratic", "dual"};

// ---- gap_close: uniaxial strain, exact on both sides of touching ----

TEST(GapCloseExactly, RoundOffOfNothingIsNoTension) {
  for (const char* space : spaces)
    for (const char* down : {"0.99999999999999e-4", "1e-4", "1.00000000000001e-4"}) {
      const Results r = solved(
          "gap_close", {{"boundary.2.displacement", std::string("{y=-") + down + "}"}, {"method.multipliers", space}});
      EXPECT_EQ(r.status, Status::solved) << space << " " << down;
      EXPECT_LE(largest_entry(r.recovery.contacts[0].pressure), 1e-3);  // Pa, where 1 % more makes 5e5
    }
}

class GapClose : public testing::TestWithParam<std::tuple<double, const char*, const char*, int>> {};

TEST_P(GapClose, IsExact) {
  const auto [down, space, side, kind] = GetParam();
  const Results r = solved("gap_close", {{"boundary.2.displacement", "{y=" + std::to_string(-down) + "e-4}"},
                                         {"method.multipliers", space},
                                         {"contact.multipliers_on", side},
                                         {"mesh.parameters.kind", std::to_string(kind)}});
  const double gap = 1e-4, d = down * 1e-4, M_upper = 210e9 * 0.7 / (1.3 * 0.4), M_lower = M_upper / 3;
  const double p = std::max(0.0, (d - gap) / (0.3 / M_upper + 0.3 / M_lower));
  EXPECT_EQ(r.status, Status::solved);
  for (const ContactSide* s : {&r.recovery.contacts[0].multiplier, &r.recovery.contacts[0].opposite})
    for (const ContactNode& n : s->nodes) {
      EXPECT_NEAR(n.p, p, 1e-10 * 47e6);
      EXPECT_NEAR(n.gap, std::max(0.0, gap - d), 1e-10 * d);
    }
  EXPECT_NEAR(r.recovery.energy, 0.8 * p * p * 0.15 * (1 / M_upper + 1 / M_lower), 1e-10 * 3769);
  EXPECT_NEAR(r.recovery.contacts[0].length_in_contact, p > 0 ? 0.8 : 0, 1e-12);
  EXPECT_LE(r.solution.steps.size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(BothSidesOfTouching, GapClose,
                         testing::Combine(testing::Values(0.5, 0.999999, 1.000001, 3), testing::ValuesIn(spaces),
                                          testing::Values("upper_contact", "lower_contact"), testing::Values(0, 1)));

// ---- Scenes where contact is lost ----

class LostContact : public testing::TestWithParam<std::tuple<const char*, bool>> {};

TEST_P(LostContact, CosineSettlesQuicklyAndIsComplementary) {
  const auto [space, on_lower] = GetParam();
  std::vector<std::pair<int, int>> meshes{{20, 25}, {25, 20}, {40, 40}, {40, 50}};
  if (space == spaces[1]) meshes.emplace_back(80, 100);  // takes longer than all others: for one space
  for (const auto& [n_upper, n_lower] : meshes) {
    const Results r = solved("cosine", {{"mesh.parameters.n_upper", std::to_string(n_upper)},
                                        {"mesh.parameters.n_lower", std::to_string(n_lower)},
                                        {"method.multipliers", space},
                                        {"contact.multipliers_on", on_lower ? "lower_contact" : "upper_contact"}});
    expect_complementary(r);
    EXPECT_LE(r.solution.steps.size(), 12u);
    EXPECT_LT(r.recovery.contacts[0].length_in_contact, r.recovery.contacts[0].length);
    EXPECT_NEAR(r.recovery.contacts[0].force.y(), on_lower ? -8e6 : 8e6, 1);                  // 10 MPa on 0.8 m
    if (n_upper >= 40) EXPECT_NEAR(r.recovery.energy, 120.157, n_upper >= 80 ? 0.015 : 0.2);  // 160x200, frozen
  }
}

TEST_P(LostContact, LiftOffPartsWhereABeamOnItsSupportWould) {
  const auto [space, on_block] = GetParam();
  const Results r = solved("lift_off", {{"method.multipliers", space},
                                        {"contact.multipliers_on", on_block ? "block_contact" : "plate_contact"}});
  expect_complementary(r);
  EXPECT_LE(r.solution.steps.size(), 12u);
  EXPECT_NEAR(r.recovery.contacts[0].length_in_contact, 0.4,
              0.1);  // a slender beam on a rigid support: 0.8 m - 2 F / q
  EXPECT_NEAR(std::abs(r.recovery.contacts[0].force.y()), 0.6e6, 1);  // pressure less the force that bends it off
  EXPECT_GT(r.recovery.contacts[0].multiplier.nodes.back().gap, 1e-5);
  EXPECT_EQ(r.recovery.contacts[0].multiplier.nodes.back().p, 0);
}

TEST_P(LostContact, APunchFacesAPartOfTheBlock) {
  const auto [space, on_block] = GetParam();
  const Results r =
      solved("punch", {{"method.multipliers", space}, {"contact.multipliers_on", on_block ? "block_top" : "foot"}});
  expect_complementary(r);
  EXPECT_NEAR(std::abs(r.recovery.contacts[0].force.y()), 2e6, 1e-3);
  EXPECT_NEAR(r.recovery.contacts[0].length_in_contact, 0.2, 1e-9);
  EXPECT_NEAR(r.recovery.energy, 10.1447, 5e-3);  // 160x200 elements, frozen
}

INSTANTIATE_TEST_SUITE_P(Spaces, LostContact, testing::Combine(testing::ValuesIn(spaces), testing::Bool()));

// ---- Bodies that only contact holds ----

TEST(Floating, ALoadThatPullsIsAnErrorThatNamesTheMotion) {
  const std::string message = message_of([] { solved("lift_off", {{"boundary.2.pressure", "-1e6"}}); });
  EXPECT_NE(message.find("body 'plate': translation (0, 1)"), std::string::npos) << message;
  EXPECT_NE(message.find("away from the contact"), std::string::npos) << message;
}

TEST(Floating, ABodyAcrossAGapIsPushedOntoTheOther) {
  // The top is pressed instead of moved: p is the pressure, whatever the gap.
  const Results r = solved("gap_close", {{"boundary.2", "{on=[\"top\"], pressure=10e6}"}});
  EXPECT_EQ(r.status, Status::solved);
  EXPECT_NEAR(r.recovery.contacts[0].p_min, 10e6, 1e-2);
  EXPECT_NEAR(r.recovery.contacts[0].p_max, 10e6, 1e-2);
}

// Nothing but contact resists the upper plate's fall and its rotation about the top, which a push from the left drives.
Scene tipping_scene(double push) {
  Scene s = clamped_scene();
  s.boundaries[0].on = {"lower_left", "lower_right"};
  BoundarySpec top, left;
  top.key = left.key = "boundary";
  top.on = {"top"};
  top.what = Displacement{0, {}};
  left.on = {"upper_left"};
  left.what = SurfaceTraction{Vec2(push, 0)};
  s.boundaries.push_back(top);
  s.boundaries.push_back(left);
  s.contacts[0].condition = Condition::unilateral;
  return s;
}

TEST(Floating, ABodyTipsOnceTheLoadLeavesItsFoot) {
  // 8 MN press at the middle of 0.8 m; push * 0.3 m acts 0.15 m below the top: it tips above 71.1 MPa.
  const Results r = solve_scene(tipping_scene(60e6), mesh_of({}));
  expect_complementary(r);
  EXPECT_LT(r.recovery.contacts[0].length_in_contact, 0.6);
  const std::string message = message_of([] { solve_scene(tipping_scene(80e6), mesh_of({})); });
  EXPECT_NE(message.find("body 'upper'"), std::string::npos) << message;
  EXPECT_NE(message.find("away from the contact"), std::string::npos) << message;
}

TEST(Floating, OfThreeBodiesTheOneThatIsPulledIsNamed) {
  const std::string message = message_of([] { solved("stack", {{"boundary.2.pressure", "-1e6"}}); });
  EXPECT_NE(message.find("body 'upper': translation (0, 1): the load"), std::string::npos) << message;
}

TEST(Floating, BilateralContactPullsTheNextBodyAlong) {
  const std::string message = message_of([] {
    solved("stack", {{"contact.0.condition", "bilateral"}, {"boundary.2.pressure", "-1e6"}});
  });
  for (const char* body : {"body 'upper': translation (0, 1)", "body 'middle': translation (0, 1)"})
    EXPECT_NE(message.find(body), std::string::npos) << message;
}

TEST(ActiveSetThatDoesNotConverge, AWarningNamesThePlaces) {
  Results r = solved("gap_close", {{"contact.multipliers_on", "lower_contact"}});
  r.solution.infeasible = {0, 11};
  const std::string line = warnings(r, large_displacement(r))[0];
  EXPECT_NE(line.find("the active set did not converge in "), std::string::npos) << line;
  EXPECT_NE(line.find("near (0.8, 0.3), near (0, 0.3)"), std::string::npos) << line;
}

// ---- Initial gaps ----

TEST(InitialGaps, AClosedGapThatIsOpenIsAnError) {
  const std::string message = message_of([] {
    solved("gap_close", {{"contact.initial_gap", "closed"}, {"mesh.parameters.gap", "2e-3"}});
  });
  for (const char* part : {"contact.0", "closed", "0.002 apart near (", "at most", "curve"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(InitialGaps, MeshesOfOneCurveAreClosedHoweverCoarse) {
  for (const char* name : {"cosine", "circle", "parabola_2", "tent_c", "rings"})
    for (const char* order : {"1", "2"})
      for (const auto& [a, b] : {std::pair("8", "11"), {"40", "12"}}) {
        const bool rings = std::string(name) == "rings";
        EXPECT_NO_THROW(check_scene(scene(name, {{"mesh.parameters.order", order},
                                                 {rings ? "mesh.parameters.n_inner" : "mesh.parameters.n_upper", a},
                                                 {rings ? "mesh.parameters.n_outer" : "mesh.parameters.n_lower", b}})))
            << name << " order " << order << " " << a << "x" << b;
      }
}

TEST(InitialGaps, OneDrawnCurveHasNoneWhateverTheMeshes) {
  for (const char* name : {"cosine", "circle", "parabola_1", "parabola_2", "rings", "tent_b"})
    for (const char* order : {"1", "2"})
      for (const char* spacing : {"0", "1"}) {
        if ((std::string(name) == "rings" || std::string(name) == "tent_b") && spacing[0] == '1') continue;
        Scene s = scene(name, {{"mesh.parameters.order", order}});
        if (spacing[0] == '1') s.mesh_parameters["spacing"] = 1;
        const Problem checked = check_scene(s);
        const double limit = std::string(name) == "cosine" ? 1e-9 : 1e-14;  // between cubics, their ends in its edges
        EXPECT_LE(checked.pairs[0].coupling.gap_max, limit) << name << order << spacing;
        EXPECT_GE(checked.pairs[0].coupling.gap_min, -limit) << name << order << spacing;
        for (const Boundary& boundary : checked.mesh.boundaries)
          EXPECT_EQ(boundary.undrawn, "") << name << order << spacing;
      }
}

TEST(InitialGaps, ADrawnGapKeepsItsValueOnAnyMesh) {
  // Concentric circles. Of gaps this large 1e-12 is many times the round-off of the places, whose difference they are.
  const std::string parts = std::string(MORTISE_SOURCE_DIR) + "/tests/parts/";
  const auto expect_gap = [](const Problem& checked, double drawn) {
    EXPECT_NEAR(checked.pairs[0].coupling.gap_min, drawn, 1e-12 * std::abs(drawn));
    EXPECT_NEAR(checked.pairs[0].coupling.gap_max, drawn, 1e-12 * std::abs(drawn));
  };
  for (const char* n : {"7", "24"}) {
    expect_gap(check_scene(read_scene(parts + "drawn_interference.toml",
                                      {{"mesh.parameters.n", n}, {"mesh.parameters.interference", "0.05"}})),
               -0.05);
    for (const char* order : {"1", "2"})
      expect_gap(check_scene(read_scene(parts + "pin_in_hole.toml", {{"mesh.parameters.n", n},
                                                                     {"mesh.parameters.order", order},
                                                                     {"mesh.parameters.clearance", "0.05"},
                                                                     {"mesh.parameters.drop", "0"}})),
                 0.05);
  }
}

TEST(InitialGaps, AClearanceIsAddedToWhatIsDrawn) {
  // 1e-4 drawn, top moved down by 3e-4: as if drawn so.
  for (const double added : {-1e-4, 5e-5})
    for (const char* gap : {"curve", "measured"}) {
      const Results r = solved("gap_close", {{"contact.clearance", std::to_string(added)},
                                             {"contact.initial_gap", gap},
                                             {"boundary.2.displacement", "{y=-3e-4}"}}),
                    drawn = solved("gap_close", {{"mesh.parameters.gap", std::to_string(1e-4 + added)},
                                                 {"boundary.2.displacement", "{y=-3e-4}"}});
      EXPECT_NEAR(r.problem.pairs[0].coupling.gap_min, 1e-4 + added, 1e-15);  // a difference of 0.3 and 0.3001
      EXPECT_NEAR(r.recovery.contacts[0].p_max, drawn.recovery.contacts[0].p_max,
                  1e-3 * drawn.recovery.contacts[0].p_max);  // the height differs
      EXPECT_GT(r.recovery.contacts[0].p_max, 0);
    }
}

TEST(InitialGaps, ANumberIsTheGapWhateverIsDrawn) {
  // Uniaxial strain of two blocks 0.3 high, geo/gap_close.toml: p = (d - g) / (0.3 / M_upper + 0.3 / M_lower).
  const double modulus = 0.7 / (1.3 * 0.4), compliance = 0.3 / (210e9 * modulus) + 0.3 / (70e9 * modulus);
  for (const char* distance : {"0", "1e-3"})
    for (const double gap : {1e-4, 0.0, -1e-4}) {
      const Results r = solved("gap_close", {{"mesh.parameters.gap", distance},
                                             {"contact.initial_gap", std::to_string(gap)},
                                             {"boundary.2.displacement", "{y=-3e-4}"}});
      EXPECT_EQ(r.problem.pairs[0].coupling.gap_min, gap);
      EXPECT_EQ(r.problem.pairs[0].coupling.gap_max, gap);
      EXPECT_NEAR(r.recovery.contacts[0].p_max, (3e-4 - gap) / compliance, 1);  // Pa, of 5e7 to 1e8
      EXPECT_NEAR(r.recovery.contacts[0].p_min, (3e-4 - gap) / compliance, 1);
      EXPECT_EQ(r.status, Status::solved);
      EXPECT_TRUE(r.warnings.empty()) << r.warnings.front();
    }
}

TEST(InitialGaps, AFunctionOfPlaceOrArcLength) {
  const Override down{"boundary.2.displacement", "{y=-3e-4}"};
  const Results by_x = solved("gap_close", {{"contact.initial_gap", "1e-4 * (1 + x)"}, down}),
                by_s = solved("gap_close", {{"contact.initial_gap", "1e-4 * (1 + s)"}, down}),
                added = solved("gap_close", {{"contact.clearance", "1e-4 * s"}, down});  // to 1e-4
  ASSERT_EQ(by_x.recovery.contacts[0].multiplier.nodes.front().position.x(), 0);         // so s = x
  for (const Results* r : {&by_s, &added})
    EXPECT_LT(largest_entry(r->recovery.contacts[0].pressure - by_x.recovery.contacts[0].pressure),
              1e-9 * by_x.recovery.contacts[0].p_max);
  for (const ContactPoint& p : by_x.problem.pairs[0].points) {
    const double x =
        edge_point(by_x.problem.mesh.nodes, by_x.problem.pairs[0].multiplier.edges[p.edge], p.xi).position.x();
    EXPECT_NEAR(p.gap, 1e-4 * (1 + x), 1e-18);
  }
  expect_contains(message_of([] {
                    solved("gap_close", {{"contact.initial_gap", "1 / (x - x)"}});
                  }),
                  "contact.0.initial_gap (--set contact.initial_gap=1 / (x - x)): '1 / (x - x)' is inf near (");
}

// ---- Starts, units ----

TEST(Start, APreviousActiveSetSavesStepsAndChangesNoAnswer) {
  const Results first = solved("lift_off");
  const ActiveSet set = active_set(first);
  const Scene next = scene("lift_off", {{"boundary.3.traction", "[0, 1.95e6]"}});
  const Results cold = solve_scene(next), warm = solve_scene(next, {}, &set);
  EXPECT_EQ(warm.solution.active, cold.solution.active);
  EXPECT_LE((warm.solution.u - cold.solution.u).cwiseAbs().maxCoeff(), 1e-10 * cold.solution.u.cwiseAbs().maxCoeff());
  // Twice the load is the same contact, on a closed gap: one step.
  const Scene twice = scene("lift_off", {{"boundary.2.pressure", "2e6"}, {"boundary.3.traction", "[0, 4e6]"}});
  EXPECT_EQ(solve_scene(twice, {}, &set).solution.steps.size(), 1u);
  EXPECT_GT(solve_scene(twice).solution.steps.size(), 1u);
}

TEST(Start, AnActiveSetOfAnotherMeshIsTakenByPlace) {
  const ActiveSet set = active_set(solved("lift_off", {{"mesh.parameters.n_block", "40"}}));
  const Results cold = solved("lift_off"), warm = solve_scene(scene("lift_off"), {}, &set);
  EXPECT_EQ(warm.solution.active, cold.solution.active);
  EXPECT_GT(cold.solution.coarse_steps, 0);
  EXPECT_LT(warm.solution.steps.size() + warm.solution.coarse_steps,
            cold.solution.steps.size() + cold.solution.coarse_steps);
  EXPECT_EQ(active_set(warm).pairs[0].size(), warm.solution.active.size());
}

TEST(Start, AnActiveSetOfOtherPairsIsIgnored) {
  ActiveSet set = active_set(solved("lift_off"));
  set.pairs.push_back(set.pairs[0]);
  const Results cold = solved("lift_off"), warm = solve_scene(scene("lift_off"), {}, &set);
  EXPECT_EQ(warm.solution.steps.size(), cold.solution.steps.size());
}

TEST(Units, UnilateralMetresAndPascalsAgreeWithMillimetresAndMegapascals) {
  TwoPlates plates;
  plates.height = [](double x) { return 0.1 * std::cos(std::numbers::pi * (x + 0.4) / 0.2) + 0.3; };
  plates.n_upper = 20;
  plates.n_lower = 25;
  Mesh metres = mesh_of(plates), millimetres = metres;
  millimetres.nodes *= 1000;
  Scene pascals = clamped_scene(), megapascals;
  pascals.boundaries[0].on = {"upper_left", "lower_left"};
  pascals.contacts[0].condition = Condition::unilateral;
  megapascals = pascals;
  megapascals.materials["steel"].young *= 1e-6;
  megapascals.boundaries.back().what = Pressure{10};
  const Results a = solve_scene(pascals, metres), b = solve_scene(megapascals, millimetres);
  EXPECT_GT(a.solution.steps.size(), 1u);
  EXPECT_EQ(a.solution.active, b.solution.active);
  EXPECT_LE((a.solution.u - b.solution.u / 1000).cwiseAbs().maxCoeff(), 1e-9 * a.solution.u.cwiseAbs().maxCoeff());
  EXPECT_LE((a.recovery.contacts[0].pressure - 1e6 * b.recovery.contacts[0].pressure).cwiseAbs().maxCoeff(),
            1e-9 * a.recovery.contacts[0].p_max);
}

}  // namespace
}  // namespace mortise::test
