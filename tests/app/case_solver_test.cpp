// Cases on one factor: what each scene says by itself, whatever came before.
#include <gtest/gtest.h>

#include <random>

#include "app/solve_scene.hpp"
#include "base/errors.hpp"
#include "scene/loads.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

using Overrides = std::vector<Override>;

Scene scene(const std::string& name, const Overrides& overrides) {
  return read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/" + name + ".toml", overrides);
}

// `tolerance`: of what each was solved to.
void expect_same(const Results& one, const Results& other, double tolerance, const std::string& of) {
  EXPECT_EQ(one.status, other.status) << of;
  EXPECT_EQ(one.solution.active, other.solution.active) << of;
  EXPECT_EQ(one.warnings, other.warnings) << of;
  ASSERT_EQ(one.solution.lambda.size(), other.solution.lambda.size()) << of;
  EXPECT_LE(largest_entry(one.solution.lambda - other.solution.lambda),
            tolerance * largest_entry(other.solution.lambda))
      << of;
  EXPECT_LE(largest_entry(one.solution.u - other.solution.u), tolerance * largest_entry(other.solution.u)) << of;
  EXPECT_LE(largest_entry(one.problem.discretisation.system.f - other.problem.discretisation.system.f),
            tolerance * largest_entry(other.problem.discretisation.system.f))
      << of;
  // Of a motion without strains it is round-off.
  const double motion = largest_entry(other.solution.u),
               round_off = 1e-14 * other.problem.discretisation.system.stiffness_scale * motion * motion;
  EXPECT_NEAR(one.recovery.energy, other.recovery.energy, 10 * tolerance * std::abs(other.recovery.energy) + round_off)
      << of;
  ASSERT_EQ(one.recovery.reactions.entries.size(), other.recovery.reactions.entries.size()) << of;
  const double force = largest_entry(other.recovery.reactions.nodal) * 100;
  for (std::size_t i = 0; i < one.recovery.reactions.entries.size(); ++i)
    EXPECT_LE((one.recovery.reactions.entries[i].force - other.recovery.reactions.entries[i].force).norm(),
              tolerance * force)
        << of;
  ASSERT_EQ(one.checks.size(), other.checks.size()) << of;
  for (std::size_t i = 0; i < one.checks.size(); ++i) EXPECT_EQ(one.checks[i].ok(), other.checks[i].ok()) << of;
}

// `tolerance`: of the largest p.
void expect_same_bars(const Results& one, const Results& other, double tolerance, const std::string& of) {
  const auto& bars = one.estimate->pressures;
  ASSERT_EQ(bars.size(), other.estimate->pressures.size()) << of;
  for (std::size_t k = 0; k < bars.size(); ++k)
    EXPECT_LE(largest_entry(bars[k].bar - other.estimate->pressures[k].bar),
              tolerance * largest_entry(other.recovery.contacts[k].pressure))
        << of;
}

// A scene, what of it is the same in all cases, and what varies: a key and values around which numbers are drawn.
struct Drawn {
  const char* name;
  Overrides fixed;
  std::vector<std::pair<std::string, std::vector<std::string>>> varied;  // %: a number between 0.2 and 2
};

std::string with_number(std::string text, double number) {
  for (std::size_t at; (at = text.find('%')) != std::string::npos;) text.replace(at, 1, std::to_string(number));
  return text;
}

class Cases : public testing::TestWithParam<Drawn> {};

TEST_P(Cases, AreWhatEachIsAlone) {
  const auto& [name, fixed, varied] = GetParam();
  for (const char* side : {"first", "second"})
    for (const char* solver : {"direct", "feti"})
      for (const char* space : {"linear", "quadratic", "dual"}) {
        std::mt19937 random(38);
        CaseSolver cases;
        Overrides common = fixed;
        common.push_back({"method.solver", solver});
        common.push_back({"method.multipliers", space});
        const ContactSpec contact = scene(name, {}).contacts[0];
        common.push_back({"contact.0.multipliers_on", contact.between[side == std::string("second")]});
        const int count = 5;
        for (int k = 0; k < count; ++k) {
          Overrides all = common;
          std::string of = std::string(name) + " " + side + " " + solver + " " + space;
          for (const auto& [key, values] : varied) {
            const std::string& drawn = values[random() % values.size()];
            all.push_back({key, with_number(drawn, std::uniform_real_distribution(0.2, 2.0)(random))});
            of += " " + key + "=" + all.back().value;
          }
          const Scene one = scene(name, all);
          const bool iterates = solver == std::string("feti");
          Results& on_factor = cases.solve(one);  // before the other has read the files of the scene
          Results alone = solve_scene(one);
          expect_same(on_factor, alone, iterates ? 1e-7 : 1e-12, of);
          estimate(on_factor);
          estimate(alone);
          expect_same_bars(on_factor, alone, iterates ? 1e-5 : 1e-8, of);
        }
        EXPECT_EQ(cases.shared(), count - 1) << name;
      }
}

// A table of values over all scenes.
std::string values_over_all() {
  static const TemporaryFolder folder;
  return folder.write("values.csv", "x,y,T\n-10,-10,1\n10,-10,2\n10,10,3\n-10,10,1.5\n");
}

INSTANTIATE_TEST_SUITE_P(
    More, Cases,
    testing::Values(
        Drawn{"punch",
              {{"mesh.parameters.n_punch", "8"},
               {"mesh.parameters.n_block", "14"},
               {"boundary.1", "{on = \"head\", rigid = {x = 0, force = [0, 0], moment = 0}}"}},
              {{"boundary.1.rigid.force", {"[0, -%e7]"}},
               {"boundary.1.rigid.moment", {"%e5", "-%e5"}},
               {"boundary.2.pressure", {"%e6", "\"%e6*(1+x)\""}}}},
        Drawn{"punch",
              {{"mesh.parameters.n_punch", "9"},
               {"mesh.parameters.n_block", "12"},
               {"mesh.parameters.kind", "0"},
               {"mesh.parameters.order", "1"},
               {"boundary.1", "{on = \"head\", pressure = 1e6}"},
               {"boundary.2", "{on = \"head\", rigid = {x = 0, y = 0, rotation = 0}}"}},
              {{"boundary.2.rigid", {"{x = 0, y = -%e-5, rotation = %e-6}", "{x = 0, y = %e-6, rotation = -%e-5}"}}}},
        Drawn{"lift_off",
              {{"mesh.parameters.n_plate", "10"},
               {"mesh.parameters.n_block", "12"},
               {"mesh.parameters.kind", "0"},
               {"boundary.1", "{on = \"bottom\", foundation = [1e12, \"1e12*(1+x)\"]}"},
               {"fields.T", "{file = \"" + values_over_all() + "\"}"}},
              {{"boundary.2.pressure", {"\"%e6*(T-T+1)\"", "\"%e6*T\"", "\"%e6*T*x\""}},
               {"boundary.3.traction", {"[0, %e6]"}}}},
        Drawn{"rings",
              {{"mesh.parameters.n_inner", "4"}, {"mesh.parameters.n_outer", "5"}},
              {{"contact.0.initial_gap", {"-%e-5", "\"%e-5*x\"", "\"-%e-5*s\""}}, {"boundary.2.pressure", {"%e7"}}}},
        Drawn{"hertz_sphere",
              {{"mesh.parameters.n_upper", "4"}, {"mesh.parameters.n_lower", "5"}},
              {{"boundary.1.pressure", {"%e4", "%e5", "\"%e5*x\""}}, {"contact.0.clearance", {"-%e-6", "%e-7"}}}}));

INSTANTIATE_TEST_SUITE_P(
    Random, Cases,
    testing::Values(Drawn{"lift_off",
                          {{"mesh.parameters.n_plate", "16"}, {"mesh.parameters.n_block", "20"}},
                          {{"boundary.2.pressure", {"%e6", "\"%e6*(1+x)\"", "\"%e6*sin(s)\""}},
                           {"boundary.3.traction", {"[0, %e6]", "[%e5, 0]", "[0, \"1e6*y*%\"]"}}}},
                    Drawn{"lift_off",
                          {{"mesh.parameters.n_plate", "12"},
                           {"mesh.parameters.n_block", "10"},
                           {"mesh.parameters.kind", "1"},
                           {"mesh.parameters.order", "1"}},
                          {{"boundary.2.pressure", {"%e6"}}, {"contact.0.clearance", {"%e-6", "-%e-6", "\"%e-6*x\""}}}},
                    Drawn{"gap_close",
                          {{"mesh.parameters.kind", "1"}, {"mesh.parameters.nine_node", "1"}},
                          {{"boundary.2.displacement", {"{y = -%e-4}"}}, {"boundary.1.displacement", {"{y = %e-5}"}}}},
                    Drawn{"gap_close",
                          {
                              {"mesh.parameters.kind", "1"},
                          },
                          {{"boundary.2.displacement", {"{normal = -%e-4}"}}}},
                    Drawn{"shrink_fit",
                          {{"mesh.parameters.n_inner", "4"}, {"mesh.parameters.n_outer", "5"}},
                          {{"initial_strain.0.temperature_change", {"-%e2", "\"-%e2*r\""}},
                           {"materials.soft.thermal_expansion", {"%e-5"}},
                           {"contact.0.clearance", {"-%e-5", "0"}}}},
                    Drawn{"stack",
                          {},
                          {{"boundary.2.pressure", {"%e7", "\"%e7*x\""}},
                           {"model.gravity", {"[0, -%]"}},
                           {"materials.steel.density", {"7850", "%e3"}}}}));

TEST(CasesThatAreNone, AreSolvedAnew) {
  const Scene one = scene("gap_close", {});
  EXPECT_TRUE(differ_in_loads_alone(one, scene("gap_close", {{"boundary.2.displacement", "{y = -1e-4}"}})));
  for (const Override& change : Overrides{{"materials.steel.young", "200e9"},
                                          {"mesh.parameters.n_upper", "8"},
                                          {"boundary.2.displacement", "{x = 0, y = -3e-4}"},
                                          {"contact.0.condition", "bilateral"},
                                          {"contact.0.initial_gap", "measured"},
                                          {"model.plane", "stress"},
                                          {"method.multipliers", "dual"}}) {
    const Scene other = scene("gap_close", {change});
    EXPECT_FALSE(differ_in_loads_alone(one, other)) << change.key;
    CaseSolver cases;
    cases.solve(one);
    expect_same(cases.solve(other), solve_scene(other), 1e-12, change.key);
    EXPECT_EQ(cases.shared(), 0) << change.key;
  }
}

// Where the displacements of both sides are prescribed they leave the gap open, or close it: its end has no pressure,
// or that of the row beside it.
TEST(CasesThatAreNone, HaveTheRowsThatTheirOwnDisplacementsLeave) {
  CaseSolver cases;
  for (const char* down : {"5e-5", "1e-4", "5e-5"}) {
    const std::string moved = "{x = 0, y = \"-" + std::string(down) + " - 7e-4 * (y - 0.3001)\"}";  // pressed on
    const Scene one = scene("gap_close", {{"boundary.0.on", "[\"upper_right\", \"lower_right\"]"},
                                          {"boundary.1.on", "[\"bottom\", \"lower_left\"]"},
                                          {"boundary.1.displacement", "{x = 0, y = 0}"},
                                          {"boundary.2.on", "[\"top\", \"upper_left\"]"},
                                          {"boundary.2.displacement", moved}});
    expect_same(cases.solve(one), solve_scene(one), 1e-12, down);
  }
  EXPECT_EQ(cases.shared(), 0);
}

// One that has no solution leaves the others as they are.
TEST(CasesThatAreNone, SpoilNoOther) {
  const Overrides pushed{{"boundary.2", "{on = [\"top\"], pressure = 1e6}"}},
      pulled{{"boundary.2", "{on = [\"top\"], pressure = -1e6}"}};
  CaseSolver cases;
  const Scene good = scene("gap_close", pushed);
  cases.solve(good);
  EXPECT_THROW(cases.solve(scene("gap_close", pulled)), InputError);
  expect_same(cases.solve(good), solve_scene(good), 1e-12, "after one without a solution");
  EXPECT_EQ(cases.shared(), 2);
}

}  // namespace
}  // namespace mortise::test
