// Materials with directions, from scene to results: uniform stresses are exact.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "app/solve_scene.hpp"
#include "support/patches.hpp"

namespace mortise::test {
namespace {

constexpr OrthotropicModuli wood{
    .e1 = 12e9, .e2 = 1e9, .e3 = 0.8e9, .nu12 = 0.4, .nu13 = 0.35, .nu23 = 0.5, .g12 = 0.7e9, .angle = 0.5};

Material of_wood(double angle) {
  OrthotropicModuli turned = wood;
  turned.angle = angle;
  return {.young = wood.e1, .moduli = turned, .stiffness = orthotropic_stiffness(turned)};
}

// Two blocks, one on the other, on a smooth table and under 10 MPa: sigma_22 = -10 MPa, and eps_22 = S_22 sigma_22.
TEST(Orthotropic, BlocksUnderPressureShortenByTheirCompliance) {
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    const auto level = [](double y) { return [=](double) { return y; }; };
    Scene scene;
    scene.model.plane = plane;
    scene.materials = {{"along", of_wood(0.5)}, {"across", of_wood(2)}};
    scene.bodies = {{"lower", "along"}, {"upper", "across"}};
    BoundarySpec table{.key = "boundary.0", .on = {"lower_south"}}, load{.key = "boundary.1", .on = {"upper_north"}};
    table.what = Displacement{{}, 0};
    load.what = Pressure{10e6};
    scene.boundaries = {table, load};
    scene.contacts = {{.key = "contact.0", .between = {"lower_north", "upper_south"}}};
    const Mesh mesh =
        mesh_of({block("lower", 3, 2, 0, 2, level(0), level(1)), block("upper", 4, 3, 0, 2, level(1), level(1.5))},
                CellKind::quad8);
    const Results r = solve_scene(scene, mesh);
    EXPECT_EQ(r.status, Status::solved);
    const VecX& p = r.recovery.contacts[0].pressure;
    EXPECT_LE(largest_entry(p - VecX::Constant(p.size(), 10e6)), 1e-8 * 10e6);
    const auto in_plane = [&](int body) {
      return Eigen::Matrix3d(r.problem.discretisation.laws[body].stiffness({0, 1, 3}, {0, 1, 3})).inverse()(1, 1);
    };
    const double shortened = 10e6 * (1.0 * in_plane(0) + 0.5 * in_plane(1));
    for (const Edge& edge : mesh.boundaries[boundary_index(mesh, "upper_north")].edges)
      EXPECT_NEAR(r.solution.u(2 * edge.nodes[0] + 1), -shortened, 1e-9 * shortened);
  }
}

// Twice the forces in a plane twice as thick, at the same pressures.
TEST(Thickness, ScalesForcesAlone) {
  const auto solved = [](const char* thickness) {
    return solve_scene(
        read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/shrink_fit.toml", {{"model.thickness", thickness}}));
  };
  const Results thick = solved("2"), thin = solved("1");
  EXPECT_EQ(thick.status, Status::solved);
  const VecX &p = thick.recovery.contacts[0].pressure, &q = thin.recovery.contacts[0].pressure;
  EXPECT_LE(largest_entry(p - q), 1e-9 * largest_entry(q));
  EXPECT_LE((thick.recovery.contacts[0].force - 2 * thin.recovery.contacts[0].force).norm(),
            1e-9 * thick.recovery.contacts[0].force.norm());
  EXPECT_NEAR(thick.recovery.energy, 2 * thin.recovery.energy, 1e-9 * thick.recovery.energy);
}

}  // namespace
}  // namespace mortise::test
