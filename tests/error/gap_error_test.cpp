// What a gap that is not known makes of p.
#include "error/gap_error.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace mortise {
namespace {

// Two edges of a line of length 1; on the second the gap is unknown by `unknown`.
ContactPair pair_with(double unknown, double gap) {
  ContactPair pair{};
  pair.multiplier.body = 0;
  pair.opposite.body = 1;
  ContactPoint point{};
  point.edge = 1;
  point.gap = gap;
  point.unknown = unknown;
  pair.points.push_back(point);
  return pair;
}

PressureLine loaded_line(std::vector<char> loaded) {
  PressureLine line;
  line.s = VecX::LinSpaced(3, 0, 1);
  line.p = VecX::Ones(3);
  line.h = VecX::Constant(3, 0.5);
  line.faced = {1, 1};
  line.loaded = std::move(loaded);
  return line;
}

const std::vector<ElasticLaw> laws(2, elastic_law(2.0, 0, {Plane::stress}));  // E* = 1

// A wave of height d and length 2 h between two bodies takes p = pi / 2 E* d / h to close it (Johnson 1985, 13.2).
TEST(GapError, IsWhatClosesAWaveAsLongAsTwoEdges) {
  const VecX found = gap_error(pair_with(1e-3, 0), laws, loaded_line({1, 1, 1}));
  EXPECT_EQ(found(0), 0);
  EXPECT_NEAR(found(1), std::numbers::pi / 2 * 1e-3 / 0.5, 1e-15);
  EXPECT_EQ(found(1), found(2));
}

TEST(GapError, IsNoneWhereTheGapIsWiderAndNothingIsLoaded) {
  EXPECT_EQ(gap_error(pair_with(1e-3, 2e-3), laws, loaded_line({1, 1, 0}))(2), 0);
  EXPECT_GT(gap_error(pair_with(1e-3, 5e-4), laws, loaded_line({1, 1, 0}))(2), 0);
}

TEST(GapError, IsAddedSoThatBarsShowItInFull) {
  const PressureLine line = loaded_line({1, 1, 1});
  LineError error(3);
  add_gap_error(line, VecX::Constant(3, 7), error);
  EXPECT_NEAR(error.pointwise(line)(1), 7, 1e-12);
}

}  // namespace
}  // namespace mortise
