// Windows that share dual solutions: how many duals, how far apart, and what it does to the bars.
#include "error/shared_duals.hpp"

#include <gtest/gtest.h>

#include "app/solve_scene.hpp"
#include "support/wall.hpp"

namespace mortise::test {
namespace {

// A square lattice of n x n windows, row by row, and a mesh of one cell at each.
std::vector<Vec2> lattice(int n) {
  std::vector<Vec2> places;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) places.emplace_back(i, j);
  return places;
}

Mesh cells_at(const std::vector<Vec2>& places) {
  std::vector<Patch> patches;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Vec2 x = places[k];
    patches.push_back(block(
        std::string("c") + std::to_string(k), 1, 1, x.x() - 0.1, x.x() + 0.1, [=](double) { return x.y() - 0.1; },
        [=](double) { return x.y() + 0.1; }));
  }
  return mesh_of(patches, CellKind::quad4);
}

TEST(SharedDuals, AreOneAWindowWhereThereAreFew) {
  const std::vector<Vec2> places = lattice(3);
  const SharedDuals shared = share_duals(cells_at(places), places, 9);
  EXPECT_EQ(shared.count, 9);
  for (int k = 0; k < 9; ++k) {
    EXPECT_EQ(shared.dual[k], k);
    EXPECT_TRUE((shared.window.col(k).array() == k).all());
  }
}

// 32 colours of a lattice can keep equal ones sqrt(32) = 5.7 apart, were the lattice without end and all windows dealt
// out together; one by one they come nearer.
TEST(SharedDuals, OfManyWindowsLieFarApart) {
  const std::vector<Vec2> places = lattice(16);
  const SharedDuals shared = share_duals(cells_at(places), places, 32);
  EXPECT_EQ(shared.count, 32);
  double nearest = 1e300;
  std::vector<int> windows(32, 0);
  for (std::size_t k = 0; k < places.size(); ++k) {
    ++windows[shared.dual[k]];
    for (std::size_t other = 0; other < k; ++other)
      if (shared.dual[k] == shared.dual[other]) nearest = std::min(nearest, (places[k] - places[other]).norm());
  }
  EXPECT_GE(nearest, 3);
  for (const int count : windows) EXPECT_GE(count, 2);
}

TEST(SharedDuals, CountInACellForTheNearestOfTheirWindows) {
  const std::vector<Vec2> places = lattice(8);
  const Mesh mesh = cells_at(places);
  const SharedDuals shared = share_duals(mesh, places, 5);
  for (Eigen::Index e = 0; e < shared.window.rows(); ++e) {
    const Vec2 x = centre_of(mesh.nodes, mesh.cells[e]);
    for (int d = 0; d < shared.count; ++d) {
      const int found = shared.window(e, d);
      ASSERT_EQ(shared.dual[found], d);
      for (std::size_t k = 0; k < places.size(); ++k)
        if (shared.dual[k] == d) EXPECT_LE((places[found] - x).norm(), (places[k] - x).norm() + 1e-12);
    }
  }
}

// However many pairs: no more back substitutions than most_duals, and nothing of size pairs x cells.
TEST(SharedDuals, OfAWallDoNotGrowWithItsPairs) {
  const Wall w = wall(6);
  Results r = solve_scene(w.scene, w.mesh);
  estimate(r);
  ASSERT_EQ(r.estimate->pressures.size(), 60U);
  EXPECT_EQ(r.estimate->far.windows.dual.size(), 180U);
  EXPECT_EQ(r.estimate->far.parts.cols(), most_duals);
  for (const PressureEstimate& e : r.estimate->pressures)
    for (const PressureWindow& window : e.windows) EXPECT_LE(window.weights.size(), 5);
}

// Against a dual for each window: the error of all lines is the same but for a few per cent. A window far from where
// the stresses are wrong is told less, for it is not told of the cells that are nearer to others.
TEST(SharedDuals, OfAWallSayWhatItsOwnSay) {
  const Wall w = wall(6);
  const Results r = solve_scene(w.scene, w.mesh);
  const auto estimated = [&](int duals) {
    return estimate_error(r.mesh, r.points, r.discretisation, r.pairs, r.solution, {}, duals);
  };
  const ErrorEstimate own = estimated(1000), shared = estimated(most_duals);
  EXPECT_EQ(own.far.parts.cols(), 180);
  EXPECT_NEAR(shared.far_field(), own.far_field(), 0.1 * own.far_field());
  EXPECT_NEAR(shared.pressure(), own.pressure(), 0.1 * own.pressure());
  EXPECT_NEAR(shared.energy.error, own.energy.error, 1e-12 * own.energy.error);
  EXPECT_LE((shared.far.parts.rowwise().sum() - own.far.parts.rowwise().sum()).cwiseAbs().maxCoeff(),
            1e-9 * own.far.parts.cwiseAbs().maxCoeff());  // duals are linear: all windows' sum is the same
}

// The bars hold against a wall of three times as many elements along each side.
TEST(SharedDuals, OfAWallKeepTheBars) {
  const int n = 5;
  const Wall coarse = wall(n, 3), fine = wall(n, 12);
  Results r = solve_scene(coarse.scene, coarse.mesh);
  estimate(r);
  const Results reference = solve_scene(fine.scene, fine.mesh);
  int nodes = 0, held = 0;
  for (std::size_t k = 0; k < r.contacts.size(); ++k)
    for (const ContactSide* side : {&r.contacts[k].multiplier, &r.contacts[k].opposite}) {
      const bool same = side->curve == reference.contacts[k].multiplier.curve;
      const std::vector<ContactNode>& exact =
          (same ? reference.contacts[k].multiplier : reference.contacts[k].opposite).nodes;
      for (const ContactNode& node : side->nodes) {
        if (!(node.p_error > 0)) continue;
        const auto nearest = std::ranges::min_element(
            exact, {}, [&](const ContactNode& other) { return (other.position - node.position).norm(); });
        ++nodes;
        held += std::abs(nearest->p - node.p) <= node.p_error;
      }
    }
  EXPECT_GT(nodes, 400);
  EXPECT_GE(held, 0.95 * nodes);
}

}  // namespace
}  // namespace mortise::test
