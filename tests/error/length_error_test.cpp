// What the length in contact may be off by, on estimates made by hand.
#include "error/length_error.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/solve_scene.hpp"
#include "contact/least_gap.hpp"
#include "error/goal_estimate.hpp"
#include "error/pressure_bars.hpp"

namespace mortise {
namespace {

class LengthError : public testing::Test {
 protected:
  static const Results& solved() {
    static const Results r = [] {
      Results made = solve_scene(read_scene(MORTISE_SOURCE_DIR "/geo/hertz.toml"));
      estimate(made);
      return made;
    }();
    return r;
  }
  double error() const { return length_error(solved().problem, pair(), solved().solution.u, e); }
  static const ContactPair& pair() { return solved().problem.pairs[0]; }
  double length(Eigen::Index edge) const { return e.line.s(edge + 1) - e.line.s(edge); }
  const LineError::Border& border() const { return e.local.borders[0]; }
  PressureEstimate e = solved().estimate->pressures[0];
};

TEST_F(LengthError, IsTheEdgeOfABorderAndWhatMovesIt) {
  ASSERT_EQ(e.local.borders.size(), 1U);
  const double edge = length(border().edge);
  EXPECT_NEAR(error(), edge + error_safety * border_motion(e, border()), 1e-12 * edge);
  const double before = border_motion(e, border());
  EXPECT_GT(before, 0);
  e.far *= 3;
  EXPECT_NEAR(border_motion(e, border()), 3 * before, 1e-12 * edge);
  EXPECT_NEAR(error(), edge + error_safety * 3 * before, 1e-12 * edge);
}

TEST_F(LengthError, HasEdgesThatCarryNoMoreThanTheirBars) {
  const double least = error();
  const Eigen::Index inner = open_vertex(e.line, border()) == border().edge ? border().edge + 3 : border().edge - 3;
  e.bar(inner) = e.line.p(inner);
  EXPECT_EQ(error(), least);  // the vertex beside it carries more
  e.bar(inner + 1) = e.line.p(inner + 1);
  EXPECT_NEAR(error(), least + length(inner), 1e-12 * length(inner));
  e.excluded[inner] = 1;  // p falls to it
  EXPECT_NEAR(error(), least + length(inner), 1e-12 * length(inner));
  e.line.p(inner) = e.bar(inner) = 2 * std::max(e.line.p(inner - 1), e.line.p(inner + 1));
  EXPECT_EQ(error(), least);
}

// A vertex without p that is taken for a swing, not for a border.
TEST_F(LengthError, HasTheEdgesBesideAVertexThatCarriesNothing) {
  const double least = error();
  const Eigen::Index inner = open_vertex(e.line, border()) == border().edge ? border().edge + 4 : border().edge - 4;
  e.line.p(inner) = 0;
  EXPECT_NEAR(error(), least + length(inner - 1) + length(inner), 1e-12 * length(inner));
}

// Of which edges the gap is closed by a pressure E* g / 2 l.
TEST_F(LengthError, HasEdgesBeyondABorderThatTheBarOfPWouldClose) {
  const double least = error();
  const std::vector<ElasticLaw>& laws = solved().problem.discretisation.laws;
  const double modulus = contact_modulus(laws[pair().multiplier.body], laws[pair().opposite.body]);
  const Eigen::Index open = open_vertex(e.line, border()), step = open == border().edge ? -1 : 1;
  const Eigen::Index edge = step < 0 ? open - 1 : open;
  double gap = 0;
  for (const ContactPoint& point : pair().points)
    if (point.edge == edge) gap = std::max(gap, gap_at(solved().solution.u, pair(), point));
  const double closes = modulus * gap / (2 * length(edge)), bar = error_safety * e.local.pointwise(e.line)(open);
  ASSERT_LT(bar, closes);  // of a contact that ends as cylinders' do
  e.local.l2 *= 0.99 * closes / bar;
  EXPECT_EQ(error(), least);
  e.local.l2 *= 1.01 / 0.99;
  EXPECT_GE(error(), least + (1 - 1e-9) * length(edge));
}

}  // namespace
}  // namespace mortise
