// Products of recovered errors of many fields.
#include "fem/error_products.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/manufactured.hpp"
#include "support/two_plates.hpp"

namespace mortise {
namespace {

// The first field's own column comes from its error point by point, the others from what that does to patches and
// nodes.
TEST(ErrorProducts, OfAFieldWithItselfAreTheSameBothWays) {
  for (const CellKind kind : all_cell_kinds)
    for (const Plane plane : {Plane::strain, Plane::stress, Plane::axisymmetric}) {
      test::TwoPlates plates;
      plates.height = [](double x) { return 0.3 + 0.1 * x - 0.2 * x * x; };
      plates.n_upper = 5;
      plates.n_lower = 7;
      plates.kind_upper = plates.kind_lower = kind;
      const Mesh mesh = test::mesh_of(plates);
      const BodyPoints points = body_points(mesh);
      const std::vector<ElasticLaw> laws(2, elastic_law(3, 0.25, {plane}));
      MatX fields(2 * mesh.nodes.rows(), 4);
      for (Eigen::Index i = 0; i < fields.rows(); ++i) fields.row(i) << std::sin(double(i)), std::cos(double(i)), 0, 0;
      fields.col(2) = fields.col(0);
      fields.col(3) = 2 * fields.col(0) - fields.col(1);
      const auto recovered = [&](MatX some) {
        return RecoveredFields{some, recover_patches(mesh, points, sample_stresses(mesh, laws, some))};
      };
      const OtherFields some = recovered(fields.col(1)), more = recovered(fields.rightCols(2));
      const ErrorProducts found = error_products(mesh, points, laws, recovered(fields.col(0)), {&some, &more});
      const MatX& products = found.products;
      const double least = 1e-10 * products.col(0).norm();
      EXPECT_GT(products.col(0).minCoeff(), 0) << int(kind) << int(plane);
      EXPECT_LE((products.col(2) - products.col(0)).norm(), least) << int(kind) << int(plane);
      EXPECT_LE((products.col(3) - 2 * products.col(0) + products.col(1)).norm(), least) << int(kind) << int(plane);
    }
}

}  // namespace
}  // namespace mortise
