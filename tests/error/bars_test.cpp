// Bars, norms and figures of an estimate, computed again from what the headers say they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "app/solve_scene.hpp"
#include "error/error_estimate.hpp"
#include "error/fitted_pressure.hpp"
#include "error/pressure_bars.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// Vertices at uneven distances, two windows with different far fields; the last vertex takes no part.
PressureEstimate made_by_hand() {
  PressureEstimate e;
  e.line.s = VecX{{0, 1, 3, 4, 6, 7}};
  e.line.p = VecX{{4, 2, 5, 1, 2, 0}};
  e.line.h = VecX{{1, 1.5, 1.5, 1.5, 1.5, 1}};
  for (const double s : e.line.s) e.line.position.emplace_back(s, 0);
  e.line.faced.assign(5, 1);
  e.line.loaded = {1, 1, 1, 1, 1, 0};
  e.local = line_error(e.line);
  for (const double s : {1.5, 4.5}) e.windows.push_back({.s = s, .place = {}, .weights = {}});
  e.far = VecX{{0.25, 0.75}};
  e.excluded.assign(6, 0);
  return e;
}

const VecX far_of{{0.25, 0.25, 0.5, 0.25 + 0.5 * 2.5 / 3, 0.75, 0}};  // linear between the windows

TEST(Bars, AreTheLocalErrorAndTheFarFieldTimesTheirSafety) {
  PressureEstimate e = made_by_hand();
  find_bars(e);
  VecX far = far_of;
  far(4) *= std::sqrt(2.5);  // contact ends a length of 1 from it and 2.5 from the last window
  EXPECT_LT((e.bar - error_safety * (e.local.pointwise(e.line) + far)).norm(), 1e-14);
  e.local.raise(2, 100);
  find_bars(e);
  EXPECT_NEAR(e.bar(2), error_safety * (100 + far_of(2)), 1e-12);
}

TEST(Bars, SquaresAreThoseOfTheNormsOfWhatCounts) {
  PressureEstimate e = made_by_hand();
  e.excluded[1] = 1;
  find_bars(e);
  double local2 = 0, far2 = 0, p2 = 0;
  for (const int i : {0, 2, 3, 4}) {
    local2 += std::pow(e.local.whole()(i), 2);
    far2 += far_of(i) * far_of(i) * e.line.h(i) * (i == 4 ? 2.5 : 1);  // beside the border
    p2 += e.line.p(i) * e.line.p(i) * e.line.h(i);
  }
  EXPECT_NEAR(e.local2, local2, 1e-12);
  EXPECT_NEAR(e.far2, far2, 1e-12);
  EXPECT_NEAR(e.p2, p2, 1e-12);
  ErrorEstimate all;
  all.pressures = {e, e};
  EXPECT_NEAR(all.pressure(), error_safety * std::sqrt((local2 + far2) / p2), 1e-12);
  EXPECT_NEAR(all.line(), std::sqrt(local2 / p2), 1e-12);
  EXPECT_NEAR(all.far_field(), std::sqrt(far2 / p2), 1e-12);
  EXPECT_NEAR(all.slopes(), std::sqrt(local2 / p2), 1e-12);
}

// As of edges that hardly face the other side: what is left beside points where p has no limit says nothing then.
TEST(Bars, WhereNoVertexIsKnownTheErrorIsPItself) {
  PressureEstimate e = made_by_hand();
  for (int i = 0; i < 5; ++i) e.local.raise(i, e.line.p(i));
  e.local.l2.setZero();
  e.far.setZero();
  find_bars(e);
  ErrorEstimate all;
  all.pressures = {e};
  EXPECT_NEAR(all.pressure(), error_safety, 1e-12);
  e.local.least(2) /= 2;
  find_bars(e);
  EXPECT_EQ(e.local2, 0);
  // Vertex 2 alone is known, and lies beside such a point: all counts.
  SingularPoint corner{};
  corner.position = e.line.position[2];
  corner.pressure_exponent = 0.5;
  e.singular = {corner};
  find_excluded(0.1, 0, e);
  EXPECT_EQ(std::ranges::count(e.excluded, 1), 0);
  e.local.least.setZero();
  find_excluded(0.1, 0, e);
  EXPECT_EQ(e.excluded[2], 1);
}

// Teeth of one curve, each loaded by itself between two corners: a tenth of its own length is left out at either end of
// each, however long the others are and wherever a closed curve begins.
TEST(Bars, LeaveOutATenthOfEachPieceAtItsEndsHoweverManyPiecesThereAre) {
  std::mt19937 draw(61);
  for (int k = 0; k < 40; ++k) {
    const int teeth = 1 + k % 9, edges = 60 * teeth, turned = k % 2 == 0 ? 0 : int(draw() % edges);
    PressureEstimate e;
    e.line = {.closed = k % 2 == 1,
              .position = {},
              .s = VecX::LinSpaced(edges + 1, 0, edges),
              .p = VecX::Zero(edges + 1),
              .fluid = {},
              .middle = {},
              .h = VecX::Ones(edges + 1),
              .faced = std::vector<char>(edges, 1),
              .loaded = std::vector<char>(edges + 1, 0)};
    const double radius = edges / (2 * std::numbers::pi);
    for (int i = 0; i <= edges; ++i)
      e.line.position.emplace_back(radius * std::cos(i / radius), radius * std::sin(i / radius));
    if (!e.line.closed)
      for (int i = 0; i <= edges; ++i) e.line.position[i] = {i, 0};
    int longest = 0, shortest = edges;
    std::vector<char> expected(edges + 1, 0);
    for (int tooth = 0; tooth < teeth; ++tooth) {
      const int length = 5 + int(draw() % 50), from = 60 * tooth + 3;
      longest = std::max(longest, length);
      shortest = std::min(shortest, length);
      for (const int end : {0, length}) {
        SingularPoint corner{};
        corner.position = e.line.position[(from + end + turned) % edges];
        corner.pressure_exponent = 0.7;
        e.singular.push_back(corner);
      }
      for (int i = from; i <= from + length; ++i) {
        const int at = (i + turned) % edges;
        e.line.loaded[at] = 1;
        e.line.p(at) = 1;
        expected[at] = std::min(i - from, from + length - i) < 0.1 * length;
        if (at == 0 && e.line.closed) e.line.loaded[edges] = e.line.p(edges) = 1;
      }
    }
    e.local = LineError(edges + 1);
    find_excluded(0.1, 0, e);
    EXPECT_NEAR(*std::ranges::max_element(e.left_out), 0.1 * longest, 1e-9) << k;
    EXPECT_NEAR(*std::ranges::min_element(e.left_out), 0.1 * shortest, 1e-9) << k;
    for (int i = 0; i <= edges && !e.line.closed; ++i)  // chords are shorter than s around a closed line
      if (e.line.loaded[i]) EXPECT_EQ(e.excluded[i], expected[i]) << k << ", " << i;
  }
}

// The corner of a side that was drawn farther away than that.
TEST(Bars, LeaveOutWhatFacesACornerAcrossAGap) {
  PressureEstimate e = made_by_hand();
  SingularPoint corner{};
  corner.pressure_exponent = 0.5;
  const auto left_out = [&](double gap) {
    corner.position = e.line.position[5] + Vec2(0, gap);
    e.singular = {corner};
    find_excluded(0.3, 0, e);
    return e.excluded;
  };
  const std::vector<char> drawn = left_out(0);
  EXPECT_EQ(drawn[5], 1);
  EXPECT_EQ(left_out(3 * e.left_out[0]), drawn);
}

// Contact that ends beside a corner, in what is left out around it, has a border there that moves no root beyond.
TEST(Bars, ABorderBesideAPointWithoutLimitIsNone) {
  PressureEstimate e = made_by_hand();
  find_excluded(0.1, 0, e);
  EXPECT_GT(std::ranges::count(e.local.border, 1), 0);
  e.local.l2(5) = 1e3;
  find_bars(e);
  const double spread = e.bar(0);
  SingularPoint corner{};
  corner.position = e.line.position[5];
  corner.pressure_exponent = 0.5;
  e.singular = {corner};
  find_excluded(0.3, 0, e);
  EXPECT_EQ(e.excluded[5], 1);
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(e.local.border[i] && e.excluded[i]) << i;
  find_bars(e);
  EXPECT_LT(e.bar(0), spread / 10);
}

// Contact that ends d further on has p = c sqrt(r + d) in the place of c sqrt(r): at the border c sqrt(d), and no more
// than that beside it. The mean of its square over where a vertex may stand in its edge counts for the far field.
TEST(Bars, BesideABorderAreThoseOfTheRootThatItMovesTo) {
  PressureEstimate e = made_by_hand();
  const double c = 2, d = 8;  // p is 2 at one length from the border; beyond a length of 2 it is linear in d
  e.far.setConstant(c * d / (2 * std::sqrt(2.5)));
  find_bars(e);
  EXPECT_NEAR(e.bar(4), error_safety * (e.local.pointwise(e.line)(4) + c * std::sqrt(d)), 1e-12);
  PressureEstimate slight = made_by_hand();
  slight.line.loaded[5] = 1;
  slight.far *= 1e-6;  // moves the border by far less than an edge
  find_bars(slight);
  const double moved = 2 * slight.far(1) * std::sqrt(2.5) / c;
  const VecX local = slight.local.pointwise(slight.line);
  EXPECT_NEAR(slight.bar(5), error_safety * (local(5) + c * std::sqrt(moved)), 1e-12);
  const double at_border = slight.far(1) * slight.far(1) * 2.5 / 0.5, on_line = c * c * moved;
  EXPECT_LT(slight.far2, 10 * at_border);
  EXPECT_NEAR(slight.local2, slight.local.whole().squaredNorm() + on_line, 0.01 * on_line);
}

TEST(Bars, PartsOfOneSignAddUpAndOthersAsIndependentErrors) {
  MatX parts(100, 3);
  parts.col(0).setConstant(-1);
  for (int i = 0; i < 100; ++i) parts(i, 1) = i % 2 == 0 ? 1 : -1;
  parts.col(2).setZero();
  parts(7, 2) = -3;
  EXPECT_LT((off_by(parts) - VecX{{100, 20, 3}}).norm(), 1e-12);
}

TEST(Bars, TheSeamOfAClosedLineCountsOnce) {
  PressureEstimate e = made_by_hand();
  e.line.loaded[5] = 1;
  EXPECT_TRUE(e.counts(0) && e.counts(5));
  e.line.closed = true;
  EXPECT_TRUE(e.counts(0));
  EXPECT_FALSE(e.counts(5));
}

TEST(Bars, OfThePeakIsThatOfTheLargestPressureOfAllPairsOrWhatMayBeMore) {
  ErrorEstimate all;
  all.pressures = {made_by_hand(), made_by_hand()};
  all.pressures[0].bar = VecX{{1, 2, 3, 4, 5, 6}};
  all.pressures[1].bar = VecX{{1, 2, 3, 4, 5, 6}};
  all.pressures[1].line.p(2) = 4.9;
  EXPECT_NEAR(all.peak(), 3.0 / 5, 1e-15);
  all.pressures[1].bar(2) = 4;
  EXPECT_NEAR(all.peak(), (4.9 + 4 - 5) / 5, 1e-15);
  all.pressures[1].line.p(2) = 8;
  EXPECT_NEAR(all.peak(), 4.0 / 8, 1e-15);
  const auto border = [](Eigen::Index edge, double part) {
    return LineError::Border{.edge = edge, .part = part, .root = 1, .reach = 1};
  };
  for (PressureEstimate& e : all.pressures) e.far.setZero();
  all.pressures[0].local.borders = {border(0, 0.1), border(3, 0.5), border(4, 0.2)};
  all.pressures[1].local.borders = {border(1, 0.3)};
  EXPECT_EQ(all.half_width(), 0.5);
  all.pressures[1].far.setConstant(1);
  const double moved = border_motion(all.pressures[1], all.pressures[1].local.borders[0]);
  EXPECT_NEAR(moved, 2 * std::sqrt(0.5), 1e-15);  // vertex 1, at 1, is open; the window at 1.5
  EXPECT_NEAR(all.half_width(), 0.3 * (1 + error_safety * moved / 2), 1e-15);
}

// A border that moves out by d brings p = c sqrt(d - r) to vertices that were open; so far its bars reach.
TEST(Bars, BeyondABorderAreThoseOfTheRootThatItBrings) {
  PressureEstimate e = made_by_hand();
  for (const double s : {8.0, 9.0, 20.0}) {
    e.line.s.conservativeResize(e.line.s.size() + 1);
    e.line.s(e.line.s.size() - 1) = s;
    e.line.position.emplace_back(s, 0);
    e.line.faced.push_back(1);
    e.line.loaded.push_back(0);
    e.excluded.push_back(0);
  }
  e.line.p.conservativeResizeLike(VecX::Zero(9));
  e.line.h.conservativeResizeLike(VecX::Ones(9));
  e.local = line_error(e.line);
  const double c = 2, d = 1;
  e.local.l2.setZero();
  e.far.setConstant(c * d / (2 * std::sqrt(2.5)));
  ASSERT_EQ(e.local.borders.size(), 1U);
  EXPECT_NEAR(border_motion(e, e.local.borders[0]), d, 1e-12);
  find_bars(e);
  const double safe = error_safety * error_safety * d;
  for (const int i : {6, 7, 8})
    EXPECT_NEAR(e.bar(i), c * std::sqrt(std::max(0.0, safe - (e.line.s(i) - 7))), 1e-12) << i;
  const double beyond = e.far2;
  e.excluded[6] = e.excluded[7] = 1;
  find_bars(e);
  EXPECT_NEAR(beyond - e.far2, c * c * (safe - 1 + safe - 2) / (error_safety * error_safety), 1e-12);
}

TEST(Bars, WhatLiesBesideAPointWithoutLimitIsLeftOut) {
  PressureEstimate e = made_by_hand();
  SingularPoint point{
      .position = {3, 0}, .edge = 1, .exponent = 0.5, .pressure_exponent = 1, .meeting = {}, .wedges = {}};
  e.singular = {point};
  find_excluded(0.3, 0, e);
  EXPECT_EQ(e.excluded, std::vector<char>(6, 0));  // p has a limit there
  e.singular[0].pressure_exponent = 0.5;
  find_excluded(0.3, 0, e);
  EXPECT_NEAR(e.left_out[0], 0.3 * 6, 1e-15);
  EXPECT_EQ(e.excluded, (std::vector<char>{0, 0, 1, 1, 0, 0}));
  e.singular[0].pressure_exponent = 1;
  e.singular[0].log_pressure = 1;
  find_excluded(0.3, 0, e);
  EXPECT_EQ(e.excluded, (std::vector<char>{0, 0, 1, 1, 0, 0}));
  find_excluded(2, 0, e);  // nothing would be left: all that is loaded counts
  EXPECT_EQ(e.excluded, (std::vector<char>{0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(e.left_out[0], 0);
}

const Results& solved(const std::string& scene) {
  static std::map<std::string, Results> known;
  const auto found = known.find(scene);
  if (found != known.end()) return found->second;
  Results r = solve_scene(read_scene(MORTISE_SOURCE_DIR + scene));
  estimate(r);
  return known.emplace(scene, std::move(r)).first->second;
}

TEST(PressureLine, LengthsAreHalvesOfTheEdgesAndTheOneEdgeOfAnEnd) {
  for (const char* scene : {"/geo/patch_flat.toml", "/geo/hertz.toml"}) {
    const Results& r = solved(scene);
    const ContactPair& pair = r.problem.pairs[0];
    const PressureLine line = pressure_line(r.problem.mesh, pair, r.solution.lambda, 0);
    const auto edge = [&](Eigen::Index e) { return edge_length(r.problem.mesh.nodes, pair.multiplier.edges[e]); };
    const Eigen::Index last = line.h.size() - 1;
    for (Eigen::Index i = 1; i < last; ++i) EXPECT_NEAR(line.h(i), (edge(i - 1) + edge(i)) / 2, 1e-15) << scene;
    EXPECT_NEAR(line.h(0), edge(0), 1e-15) << scene;
    EXPECT_NEAR(line.h(last), edge(last - 1), 1e-15) << scene;
    const PressureLine none = pressure_line(r.problem.mesh, pair, r.solution.lambda, 1e3 * line.p.maxCoeff());
    EXPECT_EQ(none.p.cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ(none.loaded, std::vector<char>(line.p.size(), 0));
  }
}

// p = c sqrt(r) over half of the contact of cylinders, and over a bump beside a long piece of little p as far as the
// bump.
TEST(PressureWindows, BesideABorderAreAsShortAsPIsARoot) {
  PressureLine line{.s = VecX::LinSpaced(2001, 0, 20), .p = VecX::Zero(2001), .faced = std::vector<char>(2000, 1)};
  const auto reach = [&](auto p) {
    for (Eigen::Index i = 0; i <= 2000; ++i) line.p(i) = p(15.005 - line.s(i));  // in the middle of an edge
    line.loaded.assign(2001, 0);
    for (Eigen::Index i = 0; i < 2000; ++i) line.loaded[i] = line.p(i) > 0;
    line.h = VecX::Constant(2001, 0.01);
    line.position.assign(2001, Vec2::Zero());
    const LineError error = line_error(line);
    EXPECT_EQ(error.borders.size(), 1U);
    return error.borders[0];
  };
  const auto bump = [](double r) { return r < 0 ? 0 : std::sqrt(r * std::max(0.0, 2 - r)) + 1e-3 * std::sqrt(r); };
  const LineError::Border hertz = reach([](double r) { return r < 0 ? 0 : std::sqrt(r * std::max(0.0, 30 - r)); });
  EXPECT_GT(hertz.reach, 0.9 * 15);
  EXPECT_EQ(windows_beside_borders(line, {hertz}), 0);  // theirs are 5 apart
  const LineError::Border beam = reach(bump);
  EXPECT_NEAR(beam.reach, 1.6, 0.05);
  EXPECT_EQ(windows_beside_borders(line, {beam}), 1);  // at 0.8; 2.4 sqrt(3) is farther than half of 5
  const LineError::Border thin = reach([&](double r) { return bump(10 * r); });
  EXPECT_NEAR(thin.reach, 0.16, 0.03);
  EXPECT_EQ(windows_beside_borders(line, {thin}), 3);
  const LineError::Border closing = reach([](double r) { return r < 0 ? 0 : std::sqrt(r * (r + 0.5)); });
  EXPECT_LT(closing.reach, 1);
}

// A window over a border has the mean of 1 / sqrt(r) of its weight (1 - z^2)^3 over half of it, at 0.1212 of its width.
TEST(PressureWindows, AtABorderOfContactKnowWhereARootsChangeHasItsMean) {
  const Results& r = solved("/geo/hertz.toml");
  const PressureEstimate& e = r.estimate->pressures[0];
  ASSERT_EQ(e.local.borders.size(), 1U);
  const Eigen::Index edge = e.local.borders[0].edge;
  const double border = e.line.s(e.line.p(edge) == 0 ? edge : edge + 1);
  int found = 0;
  for (const PressureWindow& window : e.windows) {
    if (window.from_border == 0) continue;
    ++found;
    EXPECT_NEAR(window.s, border, 1e-12);
    const double limit = 0.1212 * window_width * window.place.reach;  // of a mesh that is finer and finer
    EXPECT_NEAR(window.from_border, limit, 0.3 * limit);
  }
  EXPECT_EQ(found, 1);
  EXPECT_TRUE(std::ranges::is_sorted(e.windows, {}, &PressureWindow::s));
}

// p* farther from the multipliers' pressure than that may be off is not taken.
TEST(Bars, OfAFittedPressureAskForTheMultipliersWithinTheirs) {
  const Results& r = solved("/geo/hertz.toml");
  PressureEstimate e = r.estimate->pressures[0];
  EXPECT_EQ(e.fitted.pieces.size(), 1U);
  e.local = LineError(e.line.p.size());
  PressureFits fits;
  find_fitted_pressure(r.problem, r.problem.pairs[0], fits, e);
  EXPECT_TRUE(e.fitted.pieces.empty());
}

}  // namespace
}  // namespace mortise
