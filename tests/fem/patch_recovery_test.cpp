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

// A stress of that degree, another in each body.
Vec4 polynomial(const Vec2& x, int degree, int body) {
  Vec4 s(1 + body, 2, 3, 4);
  s += x.x() * Vec4(1, -2, 0.5, 1) + x.y() * Vec4(2, 1, 1, -3);
  if (degree == 2)
    s += x.x() * x.x() * Vec4(1, 1, 2, -1) + x.x() * x.y() * Vec4(3, -1, 0, 1) - x.y() * x.y() * Vec4(1, 2, 3, 4);
  return s;
}

Stresses polynomial_samples(const Mesh& mesh, int degree) {
  std::vector<Vec4> list;
  for (const Cell& cell : mesh.cells)
    for (const Vec2& xi : stress_points(cell.kind).points) {
      const CellShape shape = cell_shape(cell.kind, xi);
      Vec2 x = Vec2::Zero();
      for (int a = 0; a < node_count(cell.kind); ++a) x += shape.N[a] * mesh.nodes.row(cell.nodes[a]).transpose();
      list.push_back(polynomial(x, degree, cell.body));
    }
  Stresses samples(list.size(), 4);
  for (std::size_t i = 0; i < list.size(); ++i) samples.row(i) = list[i].transpose();
  return samples;
}

TEST(PatchRecovery, IsExactForPolynomials) {
  for (const CellKind kind : all_cell_kinds) {
    const Mesh mesh = test::mesh_of(plates_of(kind));
    const BodyPoints points = body_points(mesh);
    const int degree = is_quadratic(kind) ? 2 : 1;
    const std::vector<StressPatch> patches = recover_patches(mesh, points, polynomial_samples(mesh, degree));
    for (int body = 0; body < 2; ++body)
      for (int p = points.first[body]; p < points.first[body + 1]; ++p) {
        if (patches[p].terms == 0) continue;
        EXPECT_EQ(patches[p].terms, degree == 2 ? 6 : 3);
        for (const Vec2& by : {Vec2(0, 0), Vec2(0.05, -0.03)})
          EXPECT_LE((patches[p].at(patches[p].centre + by) - polynomial(patches[p].centre + by, degree, body)).norm(),
                    1e-9)
              << int(kind) << " " << p;
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
  const Stresses samples = polynomial_samples(mesh, 1);
  const std::vector<StressPatch> patches = recover_patches(mesh, points, samples);
  EXPECT_EQ(std::ranges::count(patches, 6, &StressPatch::terms), 2 * 4);  // at the ends fewer samples
  for (int body = 0; body < 2; ++body)
    for (int p = points.first[body]; p < points.first[body + 1]; ++p) {
      const StressPatch& patch = patches[p];
      if (patch.terms == 0) continue;
      EXPECT_LE((patch.at(patch.centre) - polynomial(patch.centre, 1, body)).norm(), 1e-2);  // round-off over 1e-12
    }
}

}  // namespace
}  // namespace mortise
