// Rings, from scene to results, against exact solutions: Lame's tubes and spheres, Hertz's sphere, a heated disc.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/solve_scene.hpp"
#include "support/messages.hpp"
#include "support/patches.hpp"
#include "support/plate_scenes.hpp"

namespace mortise::test {
namespace {

constexpr double pi = std::numbers::pi, young = 210e9, poisson = 0.3;

Scene rings_of(const std::vector<std::string>& bodies) {
  Scene scene;
  scene.path = "rings.toml";
  scene.model.plane = Plane::axisymmetric;
  scene.materials["steel"] = {young, poisson};
  for (const std::string& body : bodies) scene.bodies.push_back({body, "steel"});
  return scene;
}

BoundarySpec held(std::vector<std::string> on) {
  BoundarySpec spec{.key = "boundary.0", .on = std::move(on)};
  spec.what = Displacement{{}, 0};
  return spec;
}

BoundarySpec pressed(std::string on, double pressure) {
  BoundarySpec spec{.key = "boundary.1", .on = {std::move(on)}};
  spec.what = Pressure{pressure};
  return spec;
}

// Lame's pressure of 100 MPa in the bore, at the radius r of a tube (order 2) or a hollow sphere (order 3) between the
// radii 1 and 3.
double lame(double r, int order) { return 100e6 * (std::pow(3 / r, order) - 1) / (std::pow(3.0, order) - 1); }

Results tubes(int n, CellKind kind, bool on_outer = false, Solver solver = Solver::direct) {
  const auto level = [](double z) { return [=](double) { return z; }; };
  Scene scene = rings_of({"inner", "outer"});
  scene.boundaries = {held({"inner_south", "inner_north", "outer_south", "outer_north"}), pressed("inner_west", 100e6)};
  scene.contacts = {{.key = "contact.0", .between = {"inner_east", "outer_west"}}};
  scene.contacts[0].multipliers_on = on_outer ? "outer_west" : "inner_east";
  scene.method.solver = solver;
  return solve_scene(scene, mesh_of({block("inner", 2 * n, 3 * n, 1, 2, level(0), level(0.5)),
                                     block("outer", 3 * n, 4 * n, 2, 3, level(0), level(0.5))},
                                    kind));
}

double worst_pressure(const Results& r, double exact) {
  double worst = 0;
  for (const ContactNode& node : r.recovery.contacts[0].multiplier.nodes)
    worst = std::max(worst, std::abs(node.p / exact - 1));
  return worst;
}

TEST(Axisymmetric, TubesConvergeToLameOnBothMultiplierSides) {
  for (const bool on_outer : {false, true}) {
    double before = 0;
    for (const int n : {2, 4, 8, 16}) {
      const Results r = tubes(n, CellKind::quad8, on_outer);
      EXPECT_EQ(r.status, Status::solved);
      const double error = worst_pressure(r, lame(2, 2));
      if (before > 0) EXPECT_GT(std::log2(before / error), 3.7);
      before = error;
    }
    EXPECT_LT(before, 2e-8);
  }
  EXPECT_LT(worst_pressure(tubes(16, CellKind::quad4), lame(2, 2)), 1e-3);
}

TEST(Axisymmetric, ForceAndEnergyAreThoseOfTheWholeRing) {
  const Results r = tubes(8, CellKind::quad8);
  EXPECT_NEAR(r.recovery.contacts[0].force.x(), -2 * pi * 2 * 0.5 * lame(2, 2), 1e-6 * 2 * pi * 1e8);
  EXPECT_NEAR(r.recovery.contacts[0].p_mean, lame(2, 2), 1e-6 * lame(2, 2));
  // Half the work of the pressure: u = (1 + nu) / E ((1 - 2 nu) A r + B / r) at r = 1, A = B / 9 = 100 MPa / 8.
  const double u = (1 + poisson) / young * 100e6 / 8 * ((1 - 2 * poisson) + 9);
  EXPECT_NEAR(r.recovery.energy, 0.5 * 2 * pi * 0.5 * 100e6 * u, 1e-5 * r.recovery.energy);
}

TEST(Axisymmetric, EverySolverFindsTheSamePressure) {
  const VecX direct = tubes(2, CellKind::quad8).recovery.contacts[0].pressure;
  for (const Solver solver : {Solver::ddm, Solver::feti, Solver::mssor}) {
    SCOPED_TRACE(to_string(solver));
    const Results r = tubes(2, CellKind::quad8, false, solver);
    EXPECT_EQ(r.status, Status::solved);
    EXPECT_LE(largest_entry(r.recovery.contacts[0].pressure - direct), 1e-6 * largest_entry(direct));
  }
}

// Half shells from the axis down to the equator, whose normal displacement is held, pressed from within.
Results hollow_spheres(int n, Multipliers multipliers) {
  Scene scene = rings_of({"inner", "outer"});
  scene.boundaries = {held({"inner_east", "outer_east"}), pressed("inner_south", 100e6)};
  scene.contacts = {{.key = "contact.0", .between = {"inner_north", "outer_south"}}};
  scene.method.multipliers = multipliers;
  return solve_scene(scene, mesh_of({ring("inner", 4 * n, 2 * n, {0, 0}, 1, 2, 90, 0),
                                     ring("outer", 5 * n, 2 * n, {0, 0}, 2, 3, 90, 0)},
                                    CellKind::quad8));
}

TEST(Axisymmetric, HollowSpheresConvergeToLameWithContactOnTheAxis) {
  double before = 0;
  for (const int n : {2, 4, 8, 16}) {
    const Results r = hollow_spheres(n, Multipliers::linear);
    EXPECT_EQ(r.status, Status::solved);
    const double error = worst_pressure(r, lame(2, 3));
    if (before > 0) EXPECT_GT(std::log2(before / error), 1.8);
    before = error;
  }
  EXPECT_LT(before, 2e-4);
}

// int N r ds of the multiplier on the axis is zero, so that its dual function vanishes.
TEST(Axisymmetric, DualMultipliersHaveAPressureOnTheAxis) {
  double before = 1;
  for (const int n : {2, 4, 8}) {
    const double error = worst_pressure(hollow_spheres(n, Multipliers::dual), lame(2, 3));
    EXPECT_LT(error, 0.6 * before) << n;
    before = error;
  }
  EXPECT_LT(before, 0.02);
}

TEST(Axisymmetric, HertzsSphereAndItsBars) {
  const Results r = [] {
    Results solved = solve_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/hertz_sphere.toml"));
    estimate(solved, {});
    return solved;
  }();
  EXPECT_EQ(r.status, Status::solved);
  const double E_star = young / (2 * (1 - poisson * poisson)), P = pi * 48970.7517;
  const double a = std::cbrt(3 * P / (4 * E_star)), p0 = 3 * P / (2 * pi * a * a);
  EXPECT_NEAR(r.recovery.contacts[0].force.y(), P, 1e-8 * P);
  EXPECT_NEAR(r.recovery.contacts[0].length_in_contact, a, 1e-3 * a);
  EXPECT_NEAR(r.recovery.contacts[0].p_max, p0, 1e-3 * p0);
  for (const ContactNode& node : r.recovery.contacts[0].multiplier.nodes) {
    const double exact = p0 * std::sqrt(std::max(0.0, 1 - std::pow(node.position.x() / a, 2)));
    EXPECT_LE(std::abs(node.p - exact), node.p_error);
  }
}

// u = alpha dT x, without stress.
TEST(Axisymmetric, AHeatedDiscExpandsFreely) {
  const auto level = [](double z) { return [=](double) { return z; }; };
  Scene scene = rings_of({"disc"});
  scene.materials["steel"].thermal_expansion = 1e-5;
  scene.boundaries = {held({"disc_south"})};
  InitialStrainSpec heat{.key = "initial_strain.0", .body = "disc"};
  heat.temperature_change = 100;
  scene.initial_strains = {heat};
  const Mesh mesh = mesh_of({block("disc", 4, 2, 0, 1, level(0), level(0.1))}, CellKind::quad8);
  const Results r = solve_scene(scene, mesh);
  for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) {
    EXPECT_NEAR(r.solution.u(2 * i), 1e-3 * mesh.nodes(i, 0), 1e-15);
    EXPECT_NEAR(r.solution.u(2 * i + 1), 1e-3 * mesh.nodes(i, 1), 1e-15);
  }
  EXPECT_LE(r.recovery.stress.points.cwiseAbs().maxCoeff(), 1e-9 * young);
  EXPECT_LE(std::abs(r.recovery.energy), 1e-12 * young);
}

// A rigid curve of rings moves along the axis alone, though the pressure in the bore would tilt and widen it.
TEST(Axisymmetric, ARigidCurveMovesAlongTheAxisAlone) {
  const auto level = [](double z) { return [=](double) { return z; }; };
  const Mesh mesh = mesh_of({block("tube", 4, 2, 1, 2, level(0), level(0.5))}, CellKind::quad8);
  Scene scene = rings_of({"tube"});
  scene.boundaries = {held({"tube_south"}), pressed("tube_west", 100e6), held({"tube_north"})};
  scene.boundaries[2].what = RigidSpec{};
  const Results r = solve_scene(scene, mesh);
  EXPECT_EQ(r.status, Status::solved);
  ASSERT_EQ(r.recovery.reactions.rigid_motions.size(), 1u);
  const Eigen::Vector3d motion = r.recovery.reactions.rigid_motions[0];
  EXPECT_GT(std::abs(motion(1)), 1e-6);
  for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i)
    if (mesh.nodes(i, 1) == 0.5)
      EXPECT_LE((r.solution.u.segment<2>(2 * i) - Vec2(0, motion(1))).norm(), 1e-12 * std::abs(motion(1))) << i;
}

TEST(Axisymmetric, OnlyMotionsAlongTheAxisAreFree) {
  const auto level = [](double z) { return [=](double) { return z; }; };
  const Mesh mesh = mesh_of({block("tube", 2, 2, 1, 2, level(0), level(1))}, CellKind::quad8);
  Scene scene = rings_of({"tube"});
  scene.boundaries = {pressed("tube_west", 1e6)};
  const Results r = solve_scene(scene, mesh);
  EXPECT_EQ(r.status, Status::solved);
  ASSERT_FALSE(r.warnings.empty());
  expect_contains(r.warnings[0], "translation (0, 1)");
  scene.boundaries = {pressed("tube_north", 1e6)};
  expect_contains(message_of([&] { solve_scene(scene, mesh); }), "nothing holds body 'tube': translation (0, 1)");
}

TEST(Axisymmetric, RefusesWhatLiesBeyondTheAxis) {
  const auto level = [](double z) { return [=](double) { return z; }; };
  const Mesh mesh = mesh_of({block("tube", 2, 2, -1, 2, level(0), level(1))}, CellKind::quad8);
  Scene scene = rings_of({"tube"});
  expect_contains(message_of([&] { solve_scene(scene, mesh); }), "near (-1, 0), beyond the axis x = 0");
}

Mesh in_triangles(Mesh mesh) {
  std::vector<Cell> cells;
  for (const Cell& cell : mesh.cells)
    for (const auto& [a, b, c] : {std::array{0, 1, 2}, std::array{0, 2, 3}})
      cells.push_back(
          {.kind = CellKind::tri3, .body = cell.body, .nodes = {cell.nodes[a], cell.nodes[b], cell.nodes[c]}});
  mesh.cells = cells;
  return mesh;
}

// The multiplier there weighs next to nothing, and on triangles in rows it is off by a part of h.
TEST(Axisymmetric, BarsOfTheAxisHoldOnTrianglesInRows) {
  const auto level = [](double z) { return [=](double) { return z; }; };
  const auto at_axis = [&](int n, CellKind kind) {
    Scene scene = rings_of({"lower", "upper"});
    scene.boundaries = {held({"lower_south"}), pressed("upper_north", 0), held({"lower_west", "upper_west"})};
    scene.boundaries[1].what = Pressure{Field("x < 0.3 ? 3e8 : 0", {.key = "boundary.1.pressure"})};
    scene.boundaries[2].what = Displacement{0, {}};
    scene.contacts = {{.key = "contact.0", .between = {"upper_south", "lower_north"}}};
    const Mesh mesh = mesh_of(
        {block("lower", 3 * n, n, 0, 3, level(0), level(1)), block("upper", n + 1, n / 2, 0, 1, level(1), level(1.5))},
        kind);
    Results r = solve_scene(scene, kind == CellKind::quad4 ? in_triangles(mesh) : mesh);
    estimate(r, {});
    return r.recovery.contacts[0].multiplier.nodes.front();
  };
  const double exact = at_axis(32, CellKind::quad8).p;
  for (const int n : {16, 32, 64}) {
    const ContactNode node = at_axis(n, CellKind::quad4);
    EXPECT_EQ(node.s, 0);
    const double error = std::abs(node.p - exact);
    EXPECT_LE(error, node.p_error) << n;
    EXPECT_LE(node.p_error, 3 * error) << n;
  }
}

}  // namespace
}  // namespace mortise::test
