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

// Of the sides 2 and 1 at a distance of 1, where no cell is its own image.
TEST(Measures, KnowTheCentreOfATrapezium) {
  for (const CellKind kind : testing_meshes::all_kinds()) {
    Mesh mesh = testing_meshes::plate(kind, 3, 2);
    const Eigen::RowVector2d low = mesh.nodes.colwise().minCoeff(), high = mesh.nodes.colwise().maxCoeff();
    for (auto place : mesh.nodes.rowwise()) {
      place = (place - low).cwiseQuotient(high - low).eval();
      place.x() *= 2 - place.y();
    }
    const Measure body = body_measures(mesh).at(0);
    EXPECT_NEAR(body.size, 1.5, 1e-14);
    EXPECT_LE((body.centre - Vec2(7.0 / 9, 4.0 / 9)).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace mortise
