// Scenes whose loads and supports are expressions, against exact solutions that quadratic elements hold.
#include <gtest/gtest.h>

#include <numbers>

#include "app/solve_scene.hpp"
#include "results/report_text.hpp"
#include "support/messages.hpp"
#include "support/two_blocks.hpp"

namespace mortise::test {
namespace {

// Two blocks 0 <= x <= 2, the lower one from y = 0 to 1, the upper one to 1.6; E = 1000.
const std::string two_blocks = R"toml(
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, 1};
Rectangle(2) = {0, 1, 0, 2, 0.6};
)toml" + unlike_blocks;

Scene loaded_scene(const TemporaryFolder& folder, const std::string& poisson, const std::string& rest,
                   const std::string& geo = two_blocks) {
  folder.write("blocks.geo", geo);
  return read_scene(folder.write("scene.toml",
                                 "mesh.file = \"blocks.geo\"\nmodel.plane = \"stress\"\n"
                                 "materials.m = { young = 1000, poisson = " +
                                     poisson + " }\nbodies = { lower = \"m\", upper = \"m\" }\n" + rest));
}

template <typename Exact>
double displacement_error(const Results& r, const Exact& exact) {
  double error = 0, size = 0;
  for (Eigen::Index i = 0; i < r.problem.mesh.nodes.rows(); ++i) {
    const Vec2 u = exact(Vec2(r.problem.mesh.nodes.row(i)));
    error = std::max(error, (r.solution.u.segment<2>(2 * i) - u).norm());
    size = std::max(size, u.norm());
  }
  return error / size;
}

// Pure bending about the contact line, sigma_11 = k (y - 1): u = k/E (x (y - 1), -x^2/2 - nu (y - 1)^2/2), p = 0.
TEST(FunctionsOfPlace, BendingByTractionsAndDisplacementsIsExact) {
  const TemporaryFolder folder;
  const Scene scene = loaded_scene(folder, "0.3", R"toml(
boundary = [
  { on = ["lower_left", "upper_left"], displacement = { x = "0*x", y = "-1e-3 * 0.3 * (y - 1)^2 / 2" } },
  { on = ["lower_right", "upper_right"], traction = ["1 * (y - 1)", 0] },
  { on = "bottom", displacement = { x = "-1e-3*s", y = "-1e-3 * (s^2 + 0.3) / 2" } },
  { on = "top", displacement = { x = "1e-3 * x * (y - 1)", y = "-1e-3 * (x^2 + 0.3 * (y - 1)^2) / 2" } },
]
contact = [{ between = ["upper_contact", "lower_contact"], condition = "bilateral" }]
)toml");
  const Results r = solve_scene(scene);
  const auto exact = [](const Vec2& x) {
    const double y = x.y() - 1;
    return Vec2(1e-3 * x.x() * y, -1e-3 * (x.x() * x.x() + 0.3 * y * y) / 2);
  };
  EXPECT_LT(displacement_error(r, exact), 1e-10);
  EXPECT_LT(r.recovery.contacts[0].pressure.cwiseAbs().maxCoeff(), 1e-9);  // of a largest stress of 1
}

// nu = 0, pressure q (1 + x) on top: sigma_22 = -q (1 + x) everywhere, u = q/E (y^2/2, -(1 + x) y).
TEST(FunctionsOfPlace, ALinearPressureGoesThroughContactExactly) {
  const TemporaryFolder folder;
  for (const std::string load :
       {"pressure = \"3 * (1 + x)\"", "pressure = \"3 + 3*s\"", "traction = [0, \"-3 * (1 + r*cos(theta))\"]"}) {
    const Results r = solve_scene(loaded_scene(folder, "0", R"toml(
boundary = [
  { on = "bottom", displacement = { x = 0, y = 0 } },
  { on = "top", displacement = { x = "0.003 * y^2 / 2" } },
  { on = "top", )toml" + load + R"toml( },
]
contact = [{ between = ["upper_contact", "lower_contact"] }]
)toml"));
    EXPECT_LT(displacement_error(
                  r, [](const Vec2& x) { return Vec2(0.003 * x.y() * x.y() / 2, -0.003 * (1 + x.x()) * x.y()); }),
              1e-10)
        << load;
    for (const ContactNode& n : r.recovery.contacts[0].multiplier.nodes)
      EXPECT_NEAR(n.p, 3 * (1 + n.position.x()), 1e-8) << load;
    EXPECT_NEAR(r.problem.discretisation.boundary_sums[2].force.y(), -12, 1e-12);
    EXPECT_EQ(r.status, Status::solved);
  }
}

// A strain that is linear in place is compatible: alpha T = e x makes u = e ((x^2 - y^2) / 2, x y) and no stress.
TEST(FunctionsOfPlace, ALinearTemperatureStrainsWithoutStress) {
  const TemporaryFolder folder;
  const auto exact = [](const Vec2& x) -> Vec2 {
    return 1e-3 * Vec2((x.x() * x.x() - x.y() * x.y()) / 2, x.x() * x.y());
  };
  const std::string held = R"toml(
boundary = [
  { on = "bottom", displacement = { y = 0 } },
  { on = ["lower_left", "upper_left"], displacement = { x = "-1e-3 * y^2 / 2" } },
]
contact = [{ between = ["upper_contact", "lower_contact"], condition = "bilateral" }]
initial_strain = [
)toml";
  const std::string strain = R"toml(strain = { xx = "1e-3 * x", yy = "1e-3 * x", zz = 0.5 } },)toml";
  for (const std::string& entries :
       {"{ body = \"upper\", temperature_change = \"50 * x\" }, { body = \"lower\", " + strain,
        "{ body = \"lower\", temperature_change = \"50 * r*cos(theta)\" }, { body = \"upper\", " + strain}) {
    Scene scene = loaded_scene(folder, "0.3, thermal_expansion = 2e-5", held + entries + "\n]\n");
    const Results r = solve_scene(scene);
    EXPECT_LT(displacement_error(r, exact), 1e-10);
    EXPECT_LT(r.recovery.stress.points.cwiseAbs().maxCoeff(), 1e-10);  // of E times 2e-3
    EXPECT_NEAR(r.recovery.energy, 0, 1e-14);
  }
}

TEST(FunctionsOfPlace, ABodyForceHasTheForceAndMomentOfItsField) {
  const TemporaryFolder folder;
  const Scene scene = loaded_scene(folder, "0.3", R"toml(
body_force = [{ body = "lower", force = ["3 * y", "-x"] }]
)toml");
  const Mesh mesh = scene_mesh(scene);
  const Discretisation d = discretise(resolve(scene, mesh), mesh);
  EXPECT_LT((d.body_sums[0].force - Vec2(3, -2)).norm(), 1e-13);  // int of 3 y and -x over 2 x 1
  double moment = 0;
  for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i)
    moment += mesh.nodes(i, 0) * d.system.f(2 * i + 1) - mesh.nodes(i, 1) * d.system.f(2 * i);
  EXPECT_NEAR(moment, -8.0 / 3 - 2, 1e-13);  // int of -x^2 - 3 y^2, which the rule of the cells integrates
}

TEST(FunctionsOfPlace, GravityIsABodyForceByDensity) {
  const TemporaryFolder folder;
  const std::string rest =
      "boundary = [{ on = \"bottom\", displacement = { x = 0, y = 0 } }]\n"
      "contact = [{ between = [\"upper_contact\", \"lower_contact\"] }]\n";
  const Scene gravity = loaded_scene(folder, "0.3, density = 0.5", "model.gravity = [0, -10]\n" + rest);
  const Scene force = loaded_scene(folder, "0.3",
                                   "body_force = [{ body = \"lower\", force = [0, -5] }, "
                                   "{ body = \"upper\", force = [0, \"-5 + 0*x\"] }]\n" +
                                       rest);
  const Mesh mesh = scene_mesh(gravity);
  const Discretisation a = discretise(resolve(gravity, mesh), mesh), b = discretise(resolve(force, mesh), mesh);
  EXPECT_LT((a.weight.force - Vec2(0, -16)).norm(), 1e-13);  // 0.5 * 10 * 2 * 1.6
  EXPECT_LT((a.system.f - b.system.f).cwiseAbs().maxCoeff(), 1e-14);
  expect_contains(model_text(model_report(check_scene(gravity))),
                  "  load      gravity (0, -10), in sum (0, -16), moment");
  expect_contains(
      message_of([&] { loaded_scene(folder, "0.3", "model.gravity = [0, -10]\n"); }),
      "materials.m: 'density' of the material 'm' is missing; expected one, as there is gravity (model.gravity");
}

// Modulus k (1 + x) under a pressure q (1 + x), nu = 0: the bottom sinks by q/k all along, and the bodies are strained
// as on rigid ground (ALinearPressure...). Springs alone hold the bodies along y.
TEST(FunctionsOfPlace, AFoundationSinksByPressureOverModulus) {
  const TemporaryFolder folder;
  const auto exact = [](const Vec2& x) { return Vec2(0.003 * x.y() * x.y() / 2, -0.03 - 0.003 * (1 + x.x()) * x.y()); };
  for (const std::string modulus : {"\"100 * (1 + x)\"", "\"100 + 100*s\"", "[0, \"100 * (1 + x)\"]"}) {
    const Results r = solve_scene(loaded_scene(folder, "0", R"toml(
boundary = [
  { on = "bottom", foundation = )toml" + modulus + R"toml( },
  { on = "top", displacement = { x = "0.003 * y^2 / 2" } },
  { on = "lower_left", displacement = { x = "0.003 * y^2 / 2" } },
  { on = "top", pressure = "3 * (1 + x)" },
]
contact = [{ between = ["upper_contact", "lower_contact"] }]
)toml"));
    EXPECT_LT(displacement_error(r, exact), 1e-10) << modulus;
    EXPECT_EQ(r.status, Status::solved);
    // 1/2 int sigma^2 / E: 9 / 2000 times int (1 + x)^2 over 2 x 1.6.
    EXPECT_NEAR(r.recovery.energy, 9.0 / 2000 * 26 / 3 * 1.6, 1e-10);
  }
  expect_contains(
      message_of([&] {
        check_scene(loaded_scene(folder, "0", "boundary = [{ on = \"bottom\", foundation = \"x - 1\" }]\n"));
      }),
      "boundary.0 (line 5).foundation: 'x - 1' is -0.9");
}

// nu = 0, upright: under the pressure q and the weight f a volume both bodies are strained as columns, of rings too.
TEST(FunctionsOfPlace, OfRingsAFoundationSinksByPressureAndWeightOverModulus) {
  const TemporaryFolder folder;
  const double q = 3, f = 2, k = 100, young = 1000, height = 1.6;
  for (const Plane plane : {Plane::axisymmetric, Plane::strain}) {
    Scene scene = loaded_scene(folder, "0", R"toml(
boundary = [
  { on = "bottom", foundation = 100 },
  { on = ["lower_left", "upper_left"], displacement = { x = 0 } },
  { on = "top", pressure = 3 },
]
body_force = [{ body = "*", force = [0, -2] }]
contact = [{ between = ["upper_contact", "lower_contact"] }]
)toml");
    scene.model = {.plane = plane, .thickness = plane == Plane::strain ? 5.0 : 1.0};
    const Results r = solve_scene(scene);
    EXPECT_EQ(r.status, Status::solved);
    const auto exact = [&](const Vec2& x) {
      return Vec2(0, -(q + f * height) / k - (q * x.y() + f * (height * x.y() - x.y() * x.y() / 2)) / young);
    };
    // Three points integrate the stiffness of 6-node triangles in rings to 1e-4 only.
    EXPECT_LT(displacement_error(r, exact), plane == Plane::axisymmetric ? 1e-3 : 1e-10);
    EXPECT_NEAR(r.recovery.contacts[0].p_mean, q + f * 0.6, 1e-9);
    const double area = plane == Plane::axisymmetric ? 4 * std::numbers::pi : 10;
    EXPECT_NEAR(r.recovery.reactions.entries[0].force.y(), area * (q + f * height), 1e-8);
    EXPECT_NEAR(r.recovery.reactions.loads.force.y(), -area * (q + f * height), 1e-8);
  }
}

// A strain that nothing hinders makes no stress, of rings and of thick models too; its energy is all taken back.
TEST(FunctionsOfPlace, AFreeInitialStrainMakesNoStressInRingsAndThickModels) {
  const TemporaryFolder folder;
  for (const Plane plane : {Plane::axisymmetric, Plane::strain, Plane::stress}) {
    Scene scene = loaded_scene(folder, "0.3",
                               R"toml(
boundary = [
  { on = "bottom", displacement = { y = "4e-3 * x" } },
  { on = ["lower_left", "upper_left"], displacement = { x = 0 } },
]
initial_strain = [{ body = "*", strain = { xx = 1e-3, yy = 1e-3, xy = 2e-3, zz = )toml" +
                                   std::string(plane == Plane::strain ? "0" : "1e-3") + R"toml( } }]
contact = [{ between = ["upper_contact", "lower_contact"], condition = "bilateral" }]
)toml");
    scene.model = {.plane = plane, .thickness = plane == Plane::axisymmetric ? 1.0 : 5.0};
    const Results r = solve_scene(scene);
    const auto exact = [](const Vec2& x) { return Vec2(1e-3 * x.x(), 1e-3 * x.y() + 4e-3 * x.x()); };
    EXPECT_LT(displacement_error(r, exact), 1e-10);
    EXPECT_LT(r.recovery.stress.points.cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_NEAR(r.recovery.energy, 0, 1e-12);
    EXPECT_EQ(r.recovery.reactions.loads.size, 0);  // a strain is no load
  }
}

// A block that slides along its foundation is pressed by it alone: u = (d + nu q x / E, -q / k - q y / E).
TEST(FunctionsOfPlace, AFoundationDoesNotResistSliding) {
  const TemporaryFolder folder;
  const Results r = solve_scene(loaded_scene(folder, "0.3", R"toml(
boundary = [
  { on = "bottom", foundation = 100 },
  { on = ["lower_left", "upper_left"], displacement = { x = 0.02 } },
  { on = "top", pressure = 3 },
]
contact = [{ between = ["upper_contact", "lower_contact"] }]
)toml"));
  const auto exact = [](const Vec2& x) { return Vec2(0.02 + 0.9e-3 * x.x(), -0.03 - 3e-3 * x.y()); };
  EXPECT_LT(displacement_error(r, exact), 1e-10);
  EXPECT_LE(r.recovery.reactions.entries[1].force.norm(), 1e-9);
  EXPECT_LE((r.recovery.reactions.entries[0].force - Vec2(0, 6)).norm(), 1e-9);
}

TEST(FunctionsOfPlace, ASpringAlongXHoldsNothingAlongY) {
  const TemporaryFolder folder;
  const std::string scene =
      "boundary = [{ on = [\"bottom\", \"upper_left\"], foundation = [100, K] }, "
      "{ on = \"top\", pressure = 1 }]\n"
      "contact = [{ between = [\"upper_contact\", \"lower_contact\"] }]\n";
  const auto with = [&](const std::string& k) {
    std::string text = scene;
    return loaded_scene(folder, "0", text.replace(text.find('K'), 1, k));
  };
  expect_contains(message_of([&] { check_scene(with("0")); }), "nothing holds");
  const Results weak = solve_scene(with("1e-6"));  // of E = 1000
  EXPECT_EQ(weak.status, Status::solved);
}

TEST(FunctionsOfPlace, AForceIsSpreadEvenlyOverAllItsCurves) {
  const TemporaryFolder folder;
  const std::string rest = R"toml(
boundary = [
  { on = "bottom", displacement = { x = 0, y = 0 } },
  { on = "upper_left", displacement = { x = 0 } },
  { on = ["top", "upper_right"], WHAT },
]
contact = [{ between = ["upper_contact", "lower_contact"], condition = "bilateral" }]
)toml";
  const auto solved = [&](const std::string& what) {
    std::string text = rest;
    text.replace(text.find("WHAT"), 4, what);
    return solve_scene(loaded_scene(folder, "0.3", text));
  };
  const Results r = solved("force = [2.6, -5.2]"), traction = solved("traction = [1, -2]");  // 2 + 0.6 long
  EXPECT_LT((r.problem.discretisation.boundary_sums[2].force - Vec2(2.6, -5.2)).norm(), 1e-13);
  EXPECT_LT((r.solution.u - traction.solution.u).cwiseAbs().maxCoeff(), 1e-12 * r.solution.u.cwiseAbs().maxCoeff());
}

TEST(FunctionsOfPlace, AreToldAsTheyAreWritten) {
  const TemporaryFolder folder;
  const Scene scene = loaded_scene(folder, "0.3", R"toml(
boundary = [
  { on = "bottom", displacement = { x = 0, y = "1e-3 * x" } },
  { on = "top", pressure = "3 + 3*s" },
  { on = "upper_right", traction = [1e-3, "-y"] },
  { on = "lower_right", traction = [0, "1e-3 + 1e-3 * x + 1e-3 * x^2 + 1e-3 * x^3 + 1e-3 * x^4"] },
  { on = "upper_left", force = [0, -2] },
]
contact = [{ between = ["upper_contact", "lower_contact"], condition = "bilateral" }]
)toml");
  const Mesh mesh = scene_mesh(scene);
  Problem problem;
  problem.entries = resolve(scene, mesh);
  problem.discretisation = discretise(problem.entries, mesh);
  const std::string lines = model_text(model_report(problem));
  for (const char* line :
       {"  support   bottom: u_x = 0, u_y = 1e-3 * x\n", "  load      top: pressure 3 + 3*s, in sum (0, -12), moment",
        "  load      upper_right: traction (0.001, -y), in sum (0.0006, -0.78), moment",
        "  load      lower_right: traction (0, 1e-3 + 1e-3 * x + 1e-3 * x^2 + 1e-3 * x^3 + 1e ...), in sum",
        "  load      upper_left: force (0, -2), in sum (0, -2), moment"})
    expect_contains(lines, line);
  const Json json = model_report(problem);
  EXPECT_EQ(json["supports"][0]["displacement"].dump(), "{\"x\":0.0,\"y\":\"1e-3 * x\"}");
  EXPECT_EQ(json["loads"][0]["pressure"], "3 + 3*s");
  EXPECT_EQ(json["loads"][1]["traction"].dump(), "[0.001,\"-y\"]");
  EXPECT_EQ(json["loads"][2]["traction"][1], "1e-3 + 1e-3 * x + 1e-3 * x^2 + 1e-3 * x^3 + 1e-3 * x^4");
  EXPECT_EQ(json["loads"][3]["force"].dump(), "[0.0,-2.0]");
}

TEST(FunctionsOfPlace, WhatCannotBeIsNamedWithItsPlace) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& entry) {
    return message_of([&] { check_scene(loaded_scene(folder, "0.3", "boundary = [\n" + entry + "\n]\n")); });
  };
  const std::string file = folder.path("scene.toml") + ": ";
  EXPECT_EQ(message("{ on = \"lower_left\", displacement = { y = \"1 / (y - 1)\" } }"),
            file + "boundary.0.displacement.y (line 6): '1 / (y - 1)' is inf near (0, 1); expected a finite value");
  expect_contains(message("{ on = \"top\", pressure = \"2000 * x\" }"),
                  "near (1.98264, 1.6); expected a load below every Young's modulus (the largest is 1000");
  expect_contains(message("{ on = \"bottom\", displacement = { x = \"x\" } },\n"
                          "{ on = \"lower_right\", displacement = { x = \"x + 1e-6\" } }"),
                  "displacement x = 2 near (2, 0), where another boundary prescribes 2");
}

TEST(FunctionsOfPlace, ArcLengthNeedsOneChain) {
  const TemporaryFolder folder;
  std::string geo = two_blocks;
  geo.replace(geo.find("{1}; Physical Curve(\"lower_right\")"), 3, "{1, 7}");
  const std::string message = message_of(
      [&] { check_scene(loaded_scene(folder, "0.3", "boundary = [{ on = \"bottom\", pressure = \"s\" }]\n", geo)); });
  expect_contains(message, "boundary 'bottom' belongs to more than one body");
}

}  // namespace
}  // namespace mortise::test
