// Windows that share dual solutions: how many duals, how far apart, and what it does to the bars.
#include "error/shared_duals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "app/accuracy.hpp"
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

std::vector<WindowPlace> windows_at(const std::vector<Vec2>& places) {
  std::vector<WindowPlace> windows;
  for (const Vec2& x : places) windows.push_back({x, 0.5});
  return windows;
}

// Of dual d at a place of a body: the windows that it counts for, with their parts.
std::map<int, double> parts_of(const SharedDuals& shared, int body, int d, const Vec2& x) {
  std::map<int, double> parts;
  shared.for_each_window(body, d, x, [&](int window, double part) { parts[window] += part; });
  return parts;
}

TEST(SharedDuals, AreOneAWindowWhereThereAreFew) {
  const std::vector<Vec2> places = lattice(3);
  const SharedDuals shared = share_duals(cells_at(places), windows_at(places), 9);
  EXPECT_EQ(shared.count, 9);
  for (int k = 0; k < 9; ++k) {
    EXPECT_EQ(shared.dual[k], k);
    for (int body = 0; body < 9; ++body)
      EXPECT_EQ(parts_of(shared, body, k, places[body]), (std::map<int, double>{{k, 1.0}}));
  }
}

// 12 colours of a lattice can keep equal ones sqrt(12) = 3.5 apart, were the lattice without end and all windows dealt
// out together; one by one they come nearer.
TEST(SharedDuals, OfManyWindowsLieFarApart) {
  const std::vector<Vec2> places = lattice(16);
  const SharedDuals shared = share_duals(cells_at(places), windows_at(places));
  ASSERT_EQ(shared.count, shared_count);
  double nearest = 1e300;
  std::vector<int> windows(shared_count, 0);
  for (std::size_t k = 0; k < places.size(); ++k) {
    ++windows[shared.dual[k]];
    for (std::size_t other = 0; other < k; ++other)
      if (shared.dual[k] == shared.dual[other]) nearest = std::min(nearest, (places[k] - places[other]).norm());
  }
  EXPECT_GE(nearest, 2);
  for (const int count : windows) EXPECT_GE(count, 256 / shared_count / 2);
}

// Fully for the nearest window, for the others by the fourth power of the distances, both with half a spacing added;
// also in a body so large that most windows lie around it.
TEST(SharedDuals, CountForTheWindowsAroundByTheirDistance) {
  const std::vector<Vec2> places = lattice(16);
  std::vector<Patch> patches;
  for (int j = 0; j < 2; ++j)
    patches.push_back(block(
        j == 0 ? "large" : "small", 20, 2, 0, j == 0 ? 15.0 : 1.0, [=](double) { return 15.0 * j; },
        [=](double) { return 15.0 * j + (j == 0 ? 14.0 : 1.0); }));
  const Mesh mesh = mesh_of(patches, CellKind::quad4);
  const SharedDuals shared = share_duals(mesh, windows_at(places));
  for (const Cell& cell : mesh.cells) {
    const Vec2 x = centre_of(mesh.nodes, cell);
    for (int d = 0; d < shared.count; ++d) {
      double nearest = 1e300;
      for (std::size_t k = 0; k < places.size(); ++k)
        if (shared.dual[k] == d) nearest = std::min(nearest, (places[k] - x).norm() + 0.5);
      const std::map<int, double> parts = parts_of(shared, cell.body, d, x);
      EXPECT_GE(parts.size(), 2U);
      double most = 0;
      for (const auto& [window, part] : parts) {
        ASSERT_EQ(shared.dual[window], d);
        EXPECT_NEAR(part, std::pow(nearest / ((places[window] - x).norm() + 0.5), 4), 1e-12);
        most = std::max(most, part);
      }
      EXPECT_EQ(most, 1);
    }
  }
}

// However many pairs: no more duals than shared_count, and nothing of size pairs x cells.
TEST(SharedDuals, OfAWallDoNotGrowWithItsPairs) {
  const Wall w = wall(6);
  Results r = solve_scene(w.scene, w.mesh);
  estimate(r);
  ASSERT_EQ(r.estimate->pressures.size(), 60U);
  EXPECT_EQ(r.estimate->far.windows.dual.size(), 300U);
  EXPECT_EQ(r.estimate->far.parts.cols(), shared_count);
  EXPECT_EQ(r.estimate->far.overlaps.windows.size() + r.estimate->far.overlaps.pairs.size(), 360);
  for (const PressureEstimate& e : r.estimate->pressures)
    for (const PressureWindow& window : e.windows) EXPECT_LE(window.weights.size(), 5);
}

// Against a dual for each window: the error of all lines is the same but for a few per cent, and so is that of most
// windows but for a factor of two, and somewhat more as parts of its own cancel.
TEST(SharedDuals, OfAWallSayWhatItsOwnSay) {
  const Wall w = wall(6);
  const Results r = solve_scene(w.scene, w.mesh);
  const auto estimated = [&](int own_duals) {
    return estimate_error(r.problem, r.solution, *r.memory, {.own_duals = own_duals});
  };
  const ErrorEstimate own = estimated(1000), shared = estimated(most_own_duals);
  EXPECT_EQ(own.far.parts.cols(), 300);
  EXPECT_NEAR(shared.far_field(), own.far_field(), 0.1 * own.far_field());
  EXPECT_NEAR(shared.pressure(), own.pressure(), 0.1 * own.pressure());
  std::vector<double> ratios;
  for (std::size_t k = 0; k < own.pressures.size(); ++k)
    for (Eigen::Index i = 0; i < own.pressures[k].far.size(); ++i)
      ratios.push_back(shared.pressures[k].far(i) / own.pressures[k].far(i));
  std::ranges::sort(ratios);
  EXPECT_GT(ratios[ratios.size() / 2], 0.8);
  EXPECT_LT(ratios[ratios.size() / 2], 2.5);
  EXPECT_GT(ratios[ratios.size() / 20], 0.5);  // little is left out anywhere
  EXPECT_NEAR(shared.energy.error, own.energy.error, 1e-12 * own.energy.error);
  EXPECT_LE((shared.far.parts.rowwise().sum() - own.far.parts.rowwise().sum()).cwiseAbs().maxCoeff(),
            1e-9 * own.far.parts.cwiseAbs().maxCoeff());  // duals are linear: all windows' sum is the same
}

// The bars hold against a wall of four times as many elements along each side.
TEST(SharedDuals, OfAWallKeepTheBars) {
  const int n = 5;
  const Wall coarse = wall(n, 3), fine = wall(n, 12);
  Results r = solve_scene(coarse.scene, coarse.mesh);
  estimate(r);
  const Results reference = solve_scene(fine.scene, fine.mesh);
  int nodes = 0, held = 0;
  for (std::size_t k = 0; k < r.recovery.contacts.size(); ++k)
    for (const ContactSide* side : {&r.recovery.contacts[k].multiplier, &r.recovery.contacts[k].opposite}) {
      const bool same = side->curve == reference.recovery.contacts[k].multiplier.curve;
      const std::vector<ContactNode>& exact =
          (same ? reference.recovery.contacts[k].multiplier : reference.recovery.contacts[k].opposite).nodes;
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

// What overlaps at all borders do to each window is the same by one dual of all pairs as by one of each, and the shares
// of the pairs are all of it.
TEST(SharedDuals, KeepWhatOverlapsAtBordersDo) {
  const Results r = solve_scene(read_scene(MORTISE_SOURCE_DIR "/geo/rod.toml", {{"mesh.parameters.pellets", "3"}}));
  const auto estimated = [&](int own_duals) {
    return estimate_error(r.problem, r.solution, *r.memory, {.own_duals = own_duals});
  };
  const ErrorEstimate own = estimated(1000), shared = estimated(0);
  ASSERT_TRUE(own.far.windows.own() && !shared.far.windows.own());
  for (const PressureEstimate& e : shared.pressures) {  // windows stand for all that counts, and for nothing else
    double counts = 0, lengths = 0;
    for (Eigen::Index i = 0; i < e.line.p.size(); ++i) counts += e.counts(i) ? e.line.h(i) : 0;
    for (const PressureWindow& window : e.windows) lengths += window.length;
    EXPECT_NEAR(lengths, counts, 1e-12 * counts);
  }
  const VecX &windows = shared.far.overlaps.windows, &pairs = shared.far.overlaps.pairs;
  EXPECT_GT(windows.maxCoeff(), 0);
  EXPECT_LE((windows - own.far.overlaps.windows).cwiseAbs().maxCoeff(), 1e-9 * windows.maxCoeff());
  ASSERT_GT((pairs.array() > 0).count(), 2);
  double square = 0;
  Eigen::Index k = 0;
  for (const PressureEstimate& e : shared.pressures)
    for (const PressureWindow& window : e.windows) square += window.length * std::pow(windows(k++), 2);
  EXPECT_NEAR(pairs.sum(), std::sqrt(square), 1e-9 * pairs.sum());
}

// The pellets of a fuel rod press the cladding with sharp rims, where p has no limit: each of four, which share
// duals, costs no more mesh than each of two that have their own.
TEST(SharedDuals, OfManyRimsCostNoMoreMeshThanTheirOwn) {
  const auto unknowns = [](int pellets, bool own) {
    const Scene rod = read_scene(MORTISE_SOURCE_DIR "/geo/rod.toml",
                                 {{"accuracy.value", "1%"}, {"mesh.parameters.pellets", std::to_string(pellets)}});
    const auto r = solve_to_accuracy(rod);
    EXPECT_TRUE(r->accuracy->reached());
    EXPECT_EQ(r->estimate->far.windows.own(), own);
    return double(free_unknowns(*r)) / pellets;
  };
  EXPECT_LE(unknowns(4, false), 1.6 * unknowns(2, true));
}

}  // namespace
}  // namespace mortise::test
