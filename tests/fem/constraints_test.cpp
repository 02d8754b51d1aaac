// What supports prescribe of single nodes.
#include "fem/constraints.hpp"

#include <gtest/gtest.h>

#include "fem/multipoint.hpp"
#include "mesh/grid.hpp"
#include "support/messages.hpp"

namespace mortise::test {
namespace {

Mesh square() { return testing_meshes::plate(CellKind::quad4, 1, 1); }

TEST(Constraints, AValueThatContradictsAnotherIsRefused) {
  const Mesh mesh = square();
  Constraints constraints = no_constraints(mesh);
  prescribe(mesh, "first", 1, 0.001, constraints);
  prescribe(mesh, "same", 1, 0.001 * (1 + 1e-14), constraints);
  prescribe(mesh, "other component", 0, 0.5, constraints);
  EXPECT_NE(message_of([&] {
              prescribe(mesh, "second", 1, 0.0010000005, constraints);
            }).find("boundary 'second': displacement y = 0.001"),
            std::string::npos);
}

TEST(Constraints, HoldTheAxisOfRingsButForRoundOff) {
  Mesh mesh = square();
  mesh.nodes.col(0).array() -= mesh.nodes.col(0).minCoeff();
  const double size = mesh.nodes.col(0).maxCoeff();
  const auto held = [&](double off) {
    Mesh moved = mesh;
    for (Eigen::Index i = 0; i < moved.nodes.rows(); ++i)
      if (moved.nodes(i, 0) == 0) moved.nodes(i, 0) = off * size;
    Constraints constraints = no_constraints(moved);
    hold_axis(moved, constraints);
    return std::count(constraints.fixed.begin(), constraints.fixed.end(), 1);
  };
  EXPECT_EQ(held(0), 2);
  EXPECT_EQ(held(1e-12), 2);
  EXPECT_EQ(held(-1e-12), 2);
  EXPECT_EQ(held(1e-3), 0);
  EXPECT_NE(message_of([&] { held(-0.01); }).find("beyond the axis x = 0"), std::string::npos);
}

// A node that follows another one, as those of a rigid curve do, is held in both directions; one whose q are turned and
// fixed along one of them, in that.
TEST(Constraints, DirectionsOfNodesThatFollowOthersAndOfTurnedOnes) {
  const Mesh mesh = square();
  Constraints constraints = no_constraints(mesh);
  constraints.fixed[2 * 2] = 1;
  MatX T = MatX::Identity(8, 8);
  T.middleRows<2>(2 * 1) = T.middleRows<2>(2 * 0);  // node 1 follows node 0
  T.block<2, 2>(4, 4) << 0.6, -0.8, 0.8, 0.6;
  constraints.multipoint = MultipointConstraints{.T = T.sparseView(), .inverse = {}, .coupled = {}, .tied = {}};
  EXPECT_TRUE(prescribed_directions(constraints, 0).empty());
  EXPECT_EQ(prescribed_directions(constraints, 1), (std::vector<Vec2>{Vec2::UnitX(), Vec2::UnitY()}));
  EXPECT_EQ(prescribed_directions(constraints, 2), (std::vector<Vec2>{Vec2(0.6, 0.8)}));
  EXPECT_TRUE(prescribed_directions(constraints, 3).empty());
}

// One held beside others that are there already: what is held is the difference, by equal and opposite forces.
TEST(Constraints, HoldDifferencesOfUnknownsBesideOthers) {
  Constraints constraints{.fixed = std::vector<char>(8, 0), .value = VecX::Zero(8)};
  hold_differences({{0, 4}}, constraints);
  hold_differences({{3, 7}, {1, 5}}, constraints);
  EXPECT_EQ(constraints.fixed, (std::vector<char>{1, 1, 0, 1, 0, 0, 0, 0}));
  const MultipointConstraints& multipoint = *constraints.multipoint;
  EXPECT_EQ(multipoint.coupled, constraints.fixed);
  const MatX T = multipoint.T, inverse = multipoint.inverse;
  EXPECT_EQ(T * inverse, MatX::Identity(8, 8));
  const VecX q{{0, 0, 3, 0.5, 4, 5, 6, 7}}, u = T * q;
  EXPECT_EQ(u, (VecX{{4, 5, 3, 7.5, 4, 5, 6, 7}}));
  for (const int held : {0, 1, 3}) EXPECT_EQ(inverse.row(held).sum(), 0);  // the forces that hold it
}

}  // namespace
}  // namespace mortise::test
