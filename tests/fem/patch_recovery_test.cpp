// Stresses recovered by patches, and the energy error that they show.
#include "fem/patch_recovery.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fem/quadrature.hpp"
#include "support/manufactured.hpp"
#include "support/two_plates.hpp"

namespace mortise {
namespace {

using test::TwoPlates;

TwoPlates plates_of(CellKind kind) {
  TwoPlates plates;
  plates.height = [](double x) { return 0.3 + 0.1 * x - 0.2 * x * x; };
  plates.n_upper = 5;
  plates.n_lower = 7;
  plates.kind_upper = plates.kind_lower = kind;
  return plates;
}

// A stress (11, 22, 12) of that degree, another in each body.
Eigen::Vector3d polynomial(const Vec2& x, int degree, int body) {
  Eigen::Vector3d s(1 + body, 2, 4);
  s += x.x() * Eigen::Vector3d(1, -2, 1) + x.y() * Eigen::Vector3d(2, 1, -3);
  if (degree == 2)
    s += x.x() * x.x() * Eigen::Vector3d(1, 1, -1) + x.x() * x.y() * Eigen::Vector3d(3, -1, 1) -
         x.y() * x.y() * Eigen::Vector3d(1, 2, 4);
  return s;
}

// Two fields: the second is three times the first.
StressSamples polynomial_samples(const Mesh& mesh, int degree) {
  StressSamples samples = sample_stresses(mesh, std::vector<ElasticLaw>(2, elastic_law(3, 0.25, {Plane::strain})),
                                          MatX::Zero(2 * mesh.nodes.rows(), 2));
  for (std::size_t e = 0; e < mesh.cells.size(); ++e)
    for (int q = samples.first[e]; q < samples.first[e + 1]; ++q) {
      const Eigen::Vector3d s = polynomial(samples.x[q], degree, mesh.cells[e].body);
      samples.stresses.row(q) << s.transpose(), 3 * s.transpose();
    }
  return samples;
}

double off(const StressPatches& patches, int p, const Vec2& x, int degree, int body) {
  Eigen::RowVectorXd found = Eigen::RowVectorXd::Zero(6), exact(6);
  patches.add_at(p, x, 2, found);
  const Eigen::Vector3d s = 2 * polynomial(x, degree, body);
  exact << s.transpose(), 3 * s.transpose();
  return (found - exact).norm();
}

TEST(PatchRecovery, IsExactForPolynomials) {
  for (const CellKind kind : all_cell_kinds) {
    const Mesh mesh = test::mesh_of(plates_of(kind));
    const BodyPoints points = body_points(mesh);
    const int degree = is_quadratic(kind) ? 2 : 1;
    const StressPatches patches = recover_patches(mesh, points, polynomial_samples(mesh, degree));
    for (int body = 0; body < 2; ++body)
      for (int p = points.first[body]; p < points.first[body + 1]; ++p) {
        if (patches.terms[p] == 0) continue;
        EXPECT_EQ(patches.terms[p], degree == 2 ? 6 : 3);
        for (const Vec2& by : {Vec2(0, 0), Vec2(0.05, -0.03)})
          EXPECT_LE(off(patches, p, patches.centre[p] + by, degree, body), 1e-8) << int(kind) << " " << p;
      }
  }
}

TEST(PatchRecovery, EstimatesTheEnergyErrorOfAManufacturedField) {
  for (const CellKind kind : all_cell_kinds)
    for (int n = is_quadratic(kind) ? 8 : 16; n <= 64; n *= 2) {
      test::ManufacturedCase c;
      c.plates = plates_of(kind);
      c.plates.n_upper = n;
      c.plates.n_lower = n * 5 / 4;
      c.normals = Normals::curve;
      const test::Errors errors = manufactured_errors(c);
      const double effectivity = errors.energy_estimate / errors.energy;
      EXPECT_GE(effectivity, n <= 16 ? 0.8 : 0.9) << int(kind) << " " << n;
      EXPECT_LE(effectivity, n <= 16 ? 1.25 : 1.1) << int(kind) << " " << n;
      std::printf("kind %d, n %d: estimated over true energy error %.3f\n", int(kind), n, effectivity);
    }
}

TEST(PatchRecovery, ABeamOneElementThickHasAPatchEverywhere) {
  TwoPlates plates;  // flat
  plates.n_upper = plates.n_lower = 3;
  const Mesh mesh = test::mesh_of(plates);
  ASSERT_EQ(mesh.cells.size(), 6u);  // samples on two lines say nothing of y^2
  const BodyPoints points = body_points(mesh);
  const StressPatches patches = recover_patches(mesh, points, polynomial_samples(mesh, 1));
  EXPECT_EQ(std::ranges::count(patches.terms, 6), 2 * 4);  // at the ends fewer samples
  for (int body = 0; body < 2; ++body)
    for (int p = points.first[body]; p < points.first[body + 1]; ++p) {
      if (patches.terms[p] == 0) continue;
      EXPECT_LE(off(patches, p, patches.centre[p], 1, body), 5e-2);  // round-off over 1e-12
    }
}

TEST(RecoverPatches, AtSomePointsAreThoseOfAllPoints) {
  for (const CellKind kind : {CellKind::tri3, CellKind::tri6, CellKind::quad8}) {
    const Mesh mesh = test::mesh_of(plates_of(kind));
    const BodyPoints points = body_points(mesh);
    const std::vector<ElasticLaw> laws(2, elastic_law(3, 0.25, {Plane::strain}));
    VecX u(2 * mesh.nodes.rows());
    for (Eigen::Index i = 0; i < u.size(); ++i) u(i) = std::sin(double(i));
    const StressPatches all = recover_patches(mesh, points, sample_stresses(mesh, laws, u));
    const int corner = point_of(points, 0, mesh.cells[0].nodes[0]), other = point_of(points, 0, mesh.cells[9].nodes[1]);
    const StressPatches some = LocalRecovery({corner, other}, mesh, points).recover(mesh, points, laws, u);
    EXPECT_EQ(some.coefficients.rows(), 12);
    for (const int p : {corner, other}) {
      EXPECT_EQ(some.terms[p], all.terms[p]);
      EXPECT_LE((some.coefficients.middleRows<6>(some.row[p]) - all.coefficients.middleRows<6>(all.row[p])).norm(),
                1e-12 * all.coefficients.norm());
    }
  }
}

}  // namespace
}  // namespace mortise
