#include "mesh/measures.hpp"

#include <gtest/gtest.h>

#include "../mesh/grid.hpp"

namespace mortise {
namespace {

TEST(Measures, ArePlainOfAPlate) {
  for (const CellKind kind : testing_meshes::all_kinds()) {
    const Mesh plate = testing_meshes::plate(kind, 3, 2);
    const Vec2 low = plate.nodes.colwise().minCoeff(), high = plate.nodes.colwise().maxCoeff();
    const Measure body = body_measures(plate).at(0);
    EXPECT_NEAR(body.size, (high - low).prod(), 1e-14);
    EXPECT_LE((body.centre - (low + high) / 2).norm(), 1e-14);
    const Measure bottom = boundary_measures(plate).at(boundary_index(plate, "bottom"));
    EXPECT_NEAR(bottom.size, (high - low).x(), 1e-14);
    EXPECT_LE((bottom.centre - Vec2((low + high).x() / 2, low.y())).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace mortise
