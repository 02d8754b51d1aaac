#include "error/goal_estimate.hpp"

#include <gtest/gtest.h>

#include "fem/stress.hpp"
#include "support/two_plates.hpp"

namespace mortise {
namespace {

// Bending is linear in the stresses, and its mean over a slender body's thickness is zero.
TEST(StressLoads, HaveStressesThatAreLinearExactlyAtAnyPlace) {
  constexpr double young = 7, curvature = 0.3;
  for (const CellKind kind : {CellKind::tri6, CellKind::quad8, CellKind::quad9}) {
    test::TwoPlates plates;
    plates.n_upper = plates.n_lower = 4;
    plates.kind_upper = plates.kind_lower = kind;
    const Mesh mesh = test::mesh_of(plates);
    Discretisation d;
    d.laws.assign(2, elastic_law(young, 0, {Plane::stress}));
    VecX u(2 * mesh.nodes.rows());
    for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) {
      const double x = mesh.nodes(i, 0), y = mesh.nodes(i, 1);
      u.segment<2>(2 * i) = curvature * Vec2(x * y, -x * x / 2);
    }
    for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) {  // on the outline as within
      const Vec2 x = mesh.nodes.row(i);
      const auto place = locate(mesh, x.y() > 0.3 ? 0 : 1, x);
      ASSERT_TRUE(place);
      const Eigen::Vector3d stress = stress_loads(mesh, d, *place).transpose() * u;
      EXPECT_LE((stress - young * curvature * Eigen::Vector3d(x.y(), 0, 0)).norm(), 1e-10) << x.transpose();
    }
  }
}

}  // namespace
}  // namespace mortise
