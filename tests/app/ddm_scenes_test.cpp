// Domain decomposition from scene to results: the mortar method's answer, at the rates that the spectrum predicts.
#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "base/errors.hpp"
#include "preprint_solvers/interface.hpp"
#include "problem/dirichlet_neumann.hpp"
#include "support/differences.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// The bodies that took the displacement.
std::vector<std::string> displaced(const Results& r) { return dirichlet_names(r.problem.mesh, r.problem.dirichlet); }

using Overrides = std::vector<Override>;

Results run_ddm(const std::string& name, Overrides overrides, const Overrides& more = {}) {
  overrides.insert(overrides.end(), more.begin(), more.end());
  return solve_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/" + name + ".toml", overrides));
}

Results ddm(const std::string& name, Overrides overrides, const Overrides& more = {}) {
  overrides.push_back({"method.kind", "ddm"});
  return run_ddm(name, overrides, more);
}

double displacement_difference(const Results& a, const Results& b) {
  return largest_entry(a.solution.u - b.solution.u) / largest_entry(b.solution.u);
}

Overrides ddm_plates(int upper, int lower, int kind, int order) {
  return {{"mesh.parameters.n_upper", std::to_string(upper)},
          {"mesh.parameters.n_lower", std::to_string(lower)},
          {"mesh.parameters.kind", std::to_string(kind)},
          {"mesh.parameters.order", std::to_string(order)},
          {"contact.condition", "bilateral"}};
}

// The upper plate's material of its own, E = ratio * 210 GPa.
Overrides with_ratio(Overrides overrides, double ratio) {
  overrides.push_back({"materials.other", "{ young = " + std::to_string(ratio * 210e9) + ", poisson = 0.3 }"});
  overrides.push_back({"bodies.upper", "other"});
  return overrides;
}

// ---- The same answer as the mortar method's, with the same multipliers ----

class SameAnswer : public testing::TestWithParam<std::tuple<const char*, const char*, const char*>> {};

TEST_P(SameAnswer, OnAllMeshes) {
  const auto [scheme, acceleration, scene] = GetParam();
  // Neumann-Neumann and Dirichlet-Dirichlet make each body take a displacement: multipliers on the coarser side.
  const bool both = std::string(scheme) != "neumann_dirichlet";
  for (const auto& [upper, lower, kind, order] :
       {std::array{8, 10, 1, 1}, std::array{10, 8, 0, 2}, std::array{8, 8, 1, 2}, std::array{5, 12, 0, 2}})
    for (const char* side : {"upper", "lower"}) {
      const bool lower_side = std::string(side) == "lower";
      if (both && (lower_side ? lower > upper : upper > lower)) continue;
      Overrides overrides = ddm_plates(upper, lower, kind, order);
      overrides.push_back({"contact.multipliers_on", std::string(side) + "_contact"});
      const Results r = ddm(scene, overrides,
                            {{"method.scheme", scheme},
                             {"method.acceleration", acceleration},
                             {"method.dirichlet", side},
                             {"method.tolerance", "1e-10"},
                             {"method.max_iterations", "2000"}});
      const Results mortar = run_ddm(scene, overrides);
      EXPECT_NE(r.status, Status::not_converged) << upper << ":" << lower << " " << side;
      EXPECT_LT(pressure_difference(r, mortar), 1e-8) << upper << ":" << lower << " " << side;
      EXPECT_LT(displacement_difference(r, mortar), 1e-8) << upper << ":" << lower << " " << side;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Schemes, SameAnswer,
    testing::Combine(testing::Values("neumann_dirichlet", "neumann_neumann", "dirichlet_dirichlet"),
                     testing::Values("none", "aitken", "anderson", "krylov"), testing::Values("parabola_1", "tent_b")),
    [](const auto& test) {
      return std::string(std::get<0>(test.param)) + "_" + std::get<1>(test.param) + "_" + std::get<2>(test.param);
    });

TEST(Decompose, MatchesMortarOnRingsAndShrinkFit) {
  for (const char* scene : {"rings", "shrink_fit"})
    for (const char* side : {"inner", "outer"}) {
      const Overrides overrides{{"contact.multipliers_on", std::string(side) + "_contact"}};
      const Results r = ddm(scene, overrides, {{"method.dirichlet", side}, {"method.tolerance", "1e-10"}});
      EXPECT_EQ(r.status, Status::solved);
      EXPECT_LT(pressure_difference(r, run_ddm(scene, overrides)), 1e-8) << scene << " " << side;
    }
}

TEST(Decompose, StackOfThreeBodiesHasTwoInOneRole) {
  for (const Overrides& roles :
       {Overrides{{"method.dirichlet", "middle"}}, Overrides{{"method.dirichlet", "[\"lower\", \"upper\"]"}}}) {
    const Results r = ddm("stack", roles, {{"method.tolerance", "1e-11"}});
    EXPECT_EQ(r.status, Status::solved);
    EXPECT_EQ(displaced(r).size(), roles[0].value == "middle" ? 1U : 2U);
    for (const ContactResults& c : r.recovery.contacts)
      EXPECT_LT(largest_entry(c.pressure - VecX::Constant(c.pressure.size(), 10e6)) / 10e6,
                1e-10);  // exact: patch test
  }
}

// ---- Roles ----

TEST(Decompose, TheSofterBodyTakesTheDisplacement) {
  for (const double ratio : {0.1, 10.0}) {
    const Results r = ddm("parabola_1", with_ratio(ddm_plates(8, 10, 0, 2), ratio));
    EXPECT_EQ(displaced(r), std::vector<std::string>{ratio < 1 ? "upper" : "lower"});
    EXPECT_EQ(r.problem.pairs[0].spec.multipliers_on, ratio < 1 ? "upper_contact" : "lower_contact");
  }
}

TEST(Decompose, OfEquallyStiffBodiesTheFinerTakesTheDisplacement) {
  EXPECT_EQ(displaced(ddm("parabola_1", ddm_plates(8, 10, 0, 2))), std::vector<std::string>{"lower"});
  EXPECT_EQ(displaced(ddm("parabola_1", ddm_plates(10, 8, 0, 2))), std::vector<std::string>{"upper"});
}

TEST(Decompose, ContradictingRolesAreAnError) {
  expect_contains(message_of([] {
                    ddm("stack", {{"method.dirichlet", "[\"lower\", \"middle\"]"}});
                  }),
                  "'middle' is in contact with a body of the same role");
}

// ---- Rates ----

Spectrum spectrum_of(const Results& r) {
  const auto& figures = r.solution.iteration->figures;  // beta, eigenvalue.smallest, eigenvalue.largest
  return {figures[1].second, figures[2].second};
}

// A fixed beta multiplies the error by max |1 - beta mu| over the eigenvalues mu of the interface.
TEST(Decompose, FixedBetaConvergesAtThePredictedFactor) {
  for (const double ratio : {0.01, 0.1, 1.0, 10.0, 100.0})
    for (const double part : {0.2, 0.5, 0.9}) {  // of the interval in which beta converges
      Overrides overrides = with_ratio(ddm_plates(16, 20, 0, 2), ratio);
      overrides.insert(overrides.end(), {{"method.dirichlet", "upper"}, {"method.acceleration", "none"}});
      const Spectrum spectrum = spectrum_of(ddm("parabola_1", overrides, {{"method.max_iterations", "1"}}));
      const double beta = part * spectrum.largest_beta();
      const Results r = ddm(
          "parabola_1", overrides,
          {{"method.beta", std::to_string(beta)}, {"method.tolerance", "1e-10"}, {"method.max_iterations", "1000"}});
      EXPECT_NEAR(r.solution.iteration->convergence_rate / spectrum.convergence_rate(beta), 1, 0.05)
          << ratio << " " << part;
    }
}

TEST(Decompose, BeyondItsIntervalBetaDivergesAndTheRunSaysWhatWouldConverge) {
  const Overrides overrides = {{"method.dirichlet", "upper"}, {"method.acceleration", "none"}, {"method.beta", "5"}};
  const Results r = ddm("parabola_1", ddm_plates(8, 10, 0, 2), overrides);
  EXPECT_EQ(r.status, Status::not_converged);
  EXPECT_LT(r.solution.iteration->history.size(), 100U);
  EXPECT_GT(r.solution.iteration->convergence_rate, 1);
  ASSERT_FALSE(r.warnings.empty());
  expect_contains(r.warnings[0], "diverges");
  expect_contains(r.warnings[0], "beta converges below");
}

TEST(Decompose, AcceleratedItTakesAtMostFourteenEvaluations) {
  for (const char* scene : {"parabola_1", "cosine"})
    for (const double ratio : {0.01, 0.1, 1.0, 10.0, 100.0}) {
      const Results r = ddm(scene, with_ratio(ddm_plates(20, 25, 0, 2), ratio));
      EXPECT_LE(r.solution.iteration->history.size(), 14U) << scene << " " << ratio;
      EXPECT_LE(r.solution.iteration->history.back().residuals.largest(), 1e-8);
    }
}

// ---- Contact that opens ----

// `more`: settings of the mesh; the multipliers lie on `side` of both.
void expect_mortar_solution(const std::string& scene, const char* side, Overrides more, std::size_t most_steps,
                            const Overrides& method = {}) {
  more.push_back({"contact.multipliers_on", side});
  Overrides settings = method;
  settings.push_back({"method.tolerance", "1e-10"});
  const Results r = ddm(scene, more, settings), mortar = run_ddm(scene, more);
  EXPECT_NE(r.status, Status::not_converged)
      << scene << " " << to_string(r.solution.iteration->acceleration) << " " << r.solution.iteration->method;
  EXPECT_EQ(r.solution.active, mortar.solution.active) << scene;
  EXPECT_LT(pressure_difference(r, mortar), 1e-8) << scene;
  EXPECT_LE(r.solution.iteration->history.size(), most_steps) << scene;
}

Overrides sizes(const char* upper, const char* lower, const char* order = "2", const char* kind = "0") {
  return {{"mesh.parameters.n_upper", upper},
          {"mesh.parameters.n_lower", lower},
          {"mesh.parameters.order", order},
          {"mesh.parameters.kind", kind}};
}

TEST(Decompose, UnilateralFindsTheActiveSetOfTheMortarMethod) {
  for (const char* side : {"upper", "lower"})
    expect_mortar_solution("cosine", (std::string(side) + "_contact").c_str(), sizes("32", "40"), 80,
                           {{"method.dirichlet", side}});
  // A fixed-point iteration on the contact of the Dirichlet body does not settle on these two.
  expect_mortar_solution("cosine", "lower_contact", sizes("39", "51", "1", "1"), 80);
  expect_mortar_solution("cosine", "lower_contact", sizes("80", "100", "1", "1"), 80);
  expect_mortar_solution("hertz", "block_top", sizes("20", "25"), 40);
  expect_mortar_solution("lift_off", "block_contact", {}, 90);
}

TEST(Decompose, UnilateralByEachSchemeAndAcceleration) {
  for (const char* scheme : {"neumann_dirichlet", "neumann_neumann", "dirichlet_dirichlet"})
    for (const char* acceleration : {"none", "aitken", "anderson", "krylov"})
      expect_mortar_solution(
          "cosine", "upper_contact", sizes("20", "25"), 10000,
          {{"method.scheme", scheme}, {"method.acceleration", acceleration}, {"method.max_iterations", "10000"}});
}

// Leaves upon one another, held at their left ends, 12 to 60 times as long as thick, with gaps that some of them close.
std::string leaves(int count, double contrast, std::mt19937& random, const TemporaryFolder& folder) {
  std::uniform_real_distribution<double> between(0, 1);
  std::ostringstream geo, toml, materials, bodies, boundary, contact;
  const double length = 20 + 10 * between(random);
  double y = 0;
  for (int b = 0; b < count; ++b) {
    const double t = 0.5 + 0.5 * between(random), end = length * (1 - 0.5 * b / count);
    const int p = 4 * b + 1;
    const std::string name = "b" + std::to_string(b);
    geo << "Point(" << p << ") = {0, " << y << ", 0}; Point(" << p + 1 << ") = {" << end << ", " << y << ", 0}; Point("
        << p + 2 << ") = {" << end << ", " << y + t << ", 0}; Point(" << p + 3 << ") = {0, " << y + t << ", 0};\n";
    for (int k = 0; k < 4; ++k) geo << "Line(" << p + k << ") = {" << p + k << ", " << p + (k + 1) % 4 << "};\n";
    geo << "Curve Loop(" << b + 1 << ") = {" << p << ":" << p + 3 << "}; Plane Surface(" << b + 1 << ") = {" << b + 1
        << "};\nTransfinite Curve{" << p << ", " << p + 2 << "} = " << int(end / t) + 2 << "; Transfinite Curve{"
        << p + 1 << ", " << p + 3 << "} = 2; Transfinite Surface{" << b + 1 << "}; Recombine Surface{" << b + 1
        << "};\nPhysical Surface(\"" << name << "\") = {" << b + 1 << "};\n";
    for (int k = 0; k < 4; ++k)
      geo << "Physical Curve(\"" << name << std::array{"_bot", "_end", "_top", "_l"}[k] << "\") = {" << p + k << "};\n";
    materials << "materials.m" << b << " = { young = " << 1000 * std::pow(contrast, between(random))
              << ", poisson = 0.3 }\n";
    bodies << (b > 0 ? ", " : "") << name << " = \"m" << b << "\"";
    boundary << "{ on = \"" << name << "_l\", displacement = { x = 0, y = 0 } },\n";
    if (b > 0)
      contact << "{ between = [\"" << name << "_bot\", \"b" << b - 1 << "_top\"]"
              << (between(random) < 0.5 ? ", clearance = 1e-3" : "") << " },\n";
    y += t;
  }
  geo << "Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;\n";
  folder.write("leaves.geo", geo.str());
  toml << "mesh.file = \"leaves.geo\"\nmodel.plane = \"strain\"\n"
       << materials.str() << "bodies = { " << bodies.str() << " }\nboundary = [\n"
       << boundary.str() << "{ on = \"b0_bot\", pressure = 1e-4 },\n{ on = \"b" << count - 1
       << "_top\", pressure = 1e-4 },\n]\ncontact = [\n"
       << contact.str() << "]\n";
  return folder.write("leaves.toml", toml.str());
}

void expect_direct_solution(const std::string& file, const char* solver, const std::string& on_failure) {
  const Results r = solve_scene(read_scene(file, {{"method.solver", solver}}));
  Overrides same{{"method.solver", "direct"}};
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k)
    same.push_back({"contact." + std::to_string(k) + ".multipliers_on", r.problem.pairs[k].spec.multipliers_on});
  const Results direct = solve_scene(read_scene(file, same));
  EXPECT_EQ(r.solution.status, SolveStatus::converged) << on_failure;
  EXPECT_LT(displacement_difference(r, direct), 1e-6) << on_failure;
}

TEST(Decompose, ContactThatStaysOpenHasNothingToRelax) {
  for (const char* scheme : {"neumann_dirichlet", "neumann_neumann", "dirichlet_dirichlet"})
    for (const char* acceleration : {"none", "aitken", "anderson", "krylov"}) {
      const Results r = ddm(
          "gap_close",
          {{"method.scheme", scheme}, {"method.acceleration", acceleration}, {"boundary.2.displacement.y", "-0.5e-4"}});
      EXPECT_EQ(r.solution.status, SolveStatus::converged) << scheme << " " << acceleration;
      EXPECT_EQ(largest_entry(r.solution.lambda), 0) << scheme << " " << acceleration;
      for (const auto& [name, value] : r.solution.iteration->figures)
        EXPECT_TRUE(std::isfinite(value)) << scheme << " " << acceleration << " " << name;
    }
}

// A leaf between two others is a million times as stiff against what presses on both its sides as they are, whatever
// their moduli.
TEST(Decompose, FindsWhichRowsOfLeavesAreClosed) {
  std::mt19937 random(3);
  for (int k = 0; k < 6; ++k) {
    const TemporaryFolder folder;
    expect_direct_solution(leaves(2 + k / 2, 10, random, folder), "ddm", "scene " + std::to_string(k));
  }
}

// Of few rows each, and shorter than a cladding.
TEST(Feti, ConvergesOnStacksOfLeaves) {
  std::mt19937 random(4);
  for (int k = 0; k < 6; ++k) {
    const TemporaryFolder folder;
    expect_direct_solution(leaves(6 + k, 1e6, random, folder), "feti", "scene " + std::to_string(k));
  }
}

TEST(Decompose, SaysWhyItDoesNotConverge) {
  std::mt19937 random(4);
  const TemporaryFolder folder;
  const Results r = solve_scene(read_scene(leaves(11, 1e6, random, folder), {{"method.solver", "ddm"}}));
  ASSERT_EQ(r.status, Status::not_converged);
  EXPECT_GT(spectrum_of(r).largest, 1e7);
  expect_contains(r.warnings[0], "the eigenvalues of the interface are ");
  expect_contains(r.warnings[0],
                  "a body that takes the displacement is so much stiffer than its opposites, in itself or "
                  "between two of them; expected method.solver = \"feti\" or \"direct\"");
}

// ---- Errors ----

TEST(Decompose, ALoadThatPullsABodyAwayIsAnError) {
  expect_contains(message_of([] { ddm("lift_off", {{"boundary.2.pressure", "-1e6"}}); }), "nothing holds body 'plate'");
}

TEST(Decompose, MultipliersThatTheDirichletBodyDoesNotFeelAreAnError) {
  const Overrides overrides{{"mesh.parameters.n_upper", "5"},
                            {"mesh.parameters.n_lower", "40"},
                            {"method.dirichlet", "upper"},
                            {"contact.multipliers_on", "lower_contact"}};
  expect_contains(message_of([&] { ddm("parabola_1", overrides); }),
                  "is not felt by the bodies that take the displacement");
}

// On the finer side one body or the other does not feel every multiplier, whichever is called the Dirichlet body.
TEST(Decompose, SchemesThatMakeBothBodiesTakeADisplacementAskBoth) {
  for (const char* scheme : {"neumann_neumann", "dirichlet_dirichlet"})
    for (const char* dirichlet : {"upper", "lower"})
      for (const char* load :
           {"{ on = [\"top\"], pressure = 1e7 }", "{ on = [\"top\"], displacement = { y = -1e-5 } }"}) {
        const Overrides overrides{{"mesh.parameters.n_upper", "4"},   {"mesh.parameters.n_lower", "11"},
                                  {"mesh.parameters.order", "1"},     {"contact.multipliers_on", "lower_contact"},
                                  {"contact.condition", "bilateral"}, {"boundary.2", load},
                                  {"method.dirichlet", dirichlet},    {"method.scheme", scheme}};
        expect_contains(message_of([&] { ddm("patch_flat", overrides); }),
                        "is not felt by the bodies that take the displacement");
      }
}

TEST(Decompose, WithoutAContactPairThereIsNothingToIterateOn) {
  expect_contains(message_of([] { ddm("patch_flat", {{"contact", "[]"}}); }), "needs a [[contact]] to iterate on");
}

TEST(Decompose, WhatOverflowsIsNotSolved) {
  for (const char* y : {"-1e300", "-1e308"})
    for (const char* acceleration : {"none", "aitken", "anderson", "krylov"}) {
      const Results r =
          ddm("patch_flat", {{"boundary.2", std::string("{ on = [\"top\"], displacement = { y = ") + y + " } }"},
                             {"method.acceleration", acceleration}});
      EXPECT_EQ(r.status, Status::not_converged) << y << acceleration;
    }
}

// A cladding 80 long and 0.6 thick among ten pellets, in a plane where it bends freely: contact nodes' stiffness alone
// as preconditioner takes 767 steps (docs/theory.md, section 15).
TEST(Feti, TakesFewStepsWithASlenderBody) {
  const Results feti = run_ddm("pellets", {{"method.solver", "feti"}}),
                direct = run_ddm("pellets", {{"method.solver", "direct"}});
  EXPECT_EQ(feti.status, Status::solved);
  EXPECT_LE(feti.solution.iteration->steps, 100);
  EXPECT_LE(largest_entry(feti.solution.lambda - direct.solution.lambda), 1e-8 * largest_entry(direct.solution.lambda));
}

TEST(Decompose, KeysOfDomainDecompositionNeedIt) {
  expect_contains(message_of([] { run_ddm("rings", {{"method.beta", "0.3"}}); }), "expected solver = \"ddm\"");
  expect_contains(message_of([] { ddm("rings", {{"method.beta", "-1"}}); }), "method.beta");
  expect_contains(message_of([] { ddm("rings", {{"method.dirichlet", "iner"}}); }), "inner");
  expect_contains(message_of([] { ddm("rings", {{"method.max_iterations", "1.5"}}); }), "whole number");
}

}  // namespace
}  // namespace mortise::test
