// What corners of bodies do to windows near and far.
#include "error/tail_shares.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mortise {
namespace {

struct Setting {
  Mesh mesh;
  PressureLine line;
  std::vector<PressureWindow> windows;
  SharedDuals duals;
  CornerTails tails;
};

// Two windows on a line along x, and one corner above the first of them, `away` times its reach from it.
Setting with_corner(double away) {
  Setting s;
  s.mesh.bodies = {"body"};
  s.mesh.cells.push_back({});
  s.mesh.cells[0].body = 0;
  s.line.s = VecX::LinSpaced(41, 0, 2);
  for (const double x : s.line.s) s.line.position.emplace_back(x, 0);
  for (const double x : {0.5, 1.5}) {
    PressureWindow window;
    window.s = x;
    window.place = {.centre = {x, 0}, .reach = 0.1};
    window.length = 0.2;
    s.windows.push_back(window);
    s.duals.places.push_back(window.place);
  }
  s.duals.dual = {0, 1};
  s.duals.count = 2;
  s.duals.near = {{0}, {1}};
  CornerRings rings;
  rings.corner.position = {0.5, away * 0.1};
  rings.corner.exponent = 0.5;
  rings.cells[0] = {0};
  rings.radius = {0.001, 0.002};
  s.tails.corners = {rings};
  s.tails.parts = MatX::Constant(1, 2, 3);
  return s;
}

TEST(TailShares, FarFromACornerAreMeans) {
  Setting s = with_corner(9);
  const auto shares = tail_shares(s.mesh, {&s.line}, {&s.windows}, s.duals, s.tails);
  EXPECT_TRUE(shares[0].local.empty());
  EXPECT_EQ(shares[0].means(0), 3);
  EXPECT_EQ(shares[0].means(1), 3);
  EXPECT_NEAR(s.tails.norms(0), std::sqrt(2 * 0.2 * 9), 1e-12);
}

// The tail's mean over the window, with the window's weight, is what its dual says.
TEST(TailShares, NearACornerHaveItsShapeAndTheWindowsMean) {
  Setting s = with_corner(2);
  const auto shares = tail_shares(s.mesh, {&s.line}, {&s.windows}, s.duals, s.tails);
  ASSERT_EQ(shares[0].local.size(), 1u);
  EXPECT_EQ(shares[0].means(0), 0);
  EXPECT_EQ(shares[0].means(1), 3);
  const LocalTail& tail = shares[0].local[0];
  EXPECT_EQ(tail.window, 0);
  double mass = 0, sum = 0;
  for (int k = 0; k < 1000; ++k) {
    const double z = (2.0 * k + 1) / 1000 - 1, weight = std::pow(1 - z * z, 3);
    mass += weight;
    sum += weight * tail.at({0.5 + z * window_width * 0.1, 0});
  }
  EXPECT_NEAR(sum / mass, 3, 0.01);
  EXPECT_GT(tail.at({0.5, 0}), 1.5 * tail.at({0.7, 0}));
}

}  // namespace
}  // namespace mortise
