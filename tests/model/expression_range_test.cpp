#include "model/expression_range.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "fem/line_cuts.hpp"
#include "model/field_range.hpp"

namespace mortise::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Interval range_of(const std::string& text, const Interval& x) { return (*ExpressionRange::of(text, {"x"}))({x}); }

void expect_range(const std::string& text, const Interval& x, double low, double high) {
  const Interval range = range_of(text, x);
  EXPECT_NEAR(range.low, low, 1e-12) << text;
  EXPECT_NEAR(range.high, high, 1e-12) << text;
}

TEST(ExpressionRange, IsExactWhereEachVariableStandsOnce) {
  const double pi = std::numbers::pi;
  expect_range("-x^2 + 1", {-1, 2}, -3, 1);
  expect_range("2^-x", {1, 3}, 0.125, 0.5);
  expect_range("2^3^2 * x", {0, 1}, 0, 512);  // from the right
  expect_range("1 - 2 - x", {0, 1}, -2, -1);  // from the left
  expect_range("abs(x) / 2", {-4, 1}, 0, 2);
  expect_range("sin(x)", {0, 2}, 0, 1);
  expect_range("cos(pi * x)", {0.5, 1.25}, -1, 0);
  expect_range("sqrt(x)", {-1, 4}, 0, 2);  // of -1 there is none
  expect_range("max(x, 0.5, 0.25)", {0, 1}, 0.5, 1);
  expect_range("avg(x, 3)", {1, 2}, 2, 2.5);
  expect_range("atan2(x, -1)", {-1, 1}, -pi, pi);
  expect_range("x > 1 && x < 2 ? 7 : 3", {0, 0.5}, 3, 3);
  expect_range("x > 1 && x < 2 ? 7 : 3", {0, 1.5}, 3, 7);
  expect_range("x > 1 && x < 2 ? 7 : 3", {1.25, 1.5}, 7, 7);
  EXPECT_EQ(range_of("1 / x", {-1, 1}), Interval::everything());
  EXPECT_EQ(range_of("ln(x)", {0, 1}).low, -infinity);
}

// Else a smooth one is wider by the square of the box: by the mean value theorem.
TEST(ExpressionRange, IsNearlySoWhereTheyStandTwice) {
  for (const char* text : {"(x^2 + 1) / x^2", "x * cos(x) - x", "sqrt(x) / (1 + x)", "exp(x) / (exp(x) + x)",
                           "x^1.5 - tanh(x) * ln(x)", "atan2(x, 2) / asin(x / 4)", "x / (x > 0 ? x + 1 : 0)"}) {
    const double at = 1.3;
    std::array<double, 2> wider;
    for (const int fine : {0, 1}) {
      const double h = fine == 0 ? 1e-2 : 1e-3;
      const Interval all = range_of(text, {at, at + h});
      Interval found = range_of(text, {at, at});
      for (int i = 1; i <= 100; ++i) found = hull(found, range_of(text, {at + i * h / 100, at + i * h / 100}));
      wider[fine] = (all.high - all.low) - (found.high - found.low);
    }
    EXPECT_GT(wider[0], 0) << text;
    EXPECT_LT(wider[1], 2e-2 * wider[0]) << text;
  }
}

// What would have it found by luck only: a spike of any width has its height in its range.
TEST(ExpressionRange, HasSpikesOfAnyWidth) {
  expect_range("1 + 40 * exp(-((x - 0.4137) / 1e-9)^2)", {0, 1}, 1, 41);
  expect_range("1 + 40 * exp(-((x - 0.4137) / 1e-9)^2)", {0, 0.41}, 1, 1);
}

TEST(ExpressionRange, IsNoneOfWhatItDoesNotKnow) {
  for (const char* text : {"z + 1", "foo(x)", "x +", "(x", "x y", "atan2(x)", "log(x)", ""})
    EXPECT_FALSE(ExpressionRange::of(text, {"x"})) << text;
}

// Expressions at random: muParser's values at random places of a box lie in its range.
TEST(ExpressionRange, ContainsAllValues) {
  std::mt19937 random(1);
  const auto draw = [&](int count) { return int(random() % unsigned(count)); };
  const std::function<std::string(int)> text = [&](int depth) -> std::string {
    if (depth == 0) return draw(3) == 0 ? std::to_string(draw(40) / 10.0) : draw(2) == 0 ? "x" : "y";
    const std::string a = text(depth - 1), b = text(depth - 1);
    switch (draw(12)) {
      case 0:
        return a + " - (" + b + ")";
      case 1:
        return "(" + a + ") * (" + b + ")";
      case 2:
        return "(-(" + b + ")^2 + " + a + ")";
      case 3:
        return "(" + a + " < " + b + " ? " + b + " : r + " + a + ")";
      case 4:
        return std::string(draw(2) == 0 ? "sin" : "tanh") + "(" + a + ")";
      case 5:
        return "exp(-abs(" + a + ")) / (1.5 + cos(" + b + "))";
      case 6:
        return "sqrt(abs(" + a + ")) - ln(1 + abs(" + b + "))";
      case 7:
        return "atan2(" + a + ", " + b + ")";
      case 8:
        return "(1.1 + tanh(" + a + "))^sin(" + b + ")";
      case 9:
        return "asinh(" + a + ") * acos(tanh(" + b + ") / 2)";
      case 10:
        return "avg(atan(" + a + "), " + b + ", rint(" + a + "))";
      default:
        return "min(" + a + ", theta, " + b + ")";
    }
  };
  std::uniform_real_distribution<double> place(-2, 2), part(0, 1);
  for (int k = 0; k < 1000; ++k) {
    const Field field(text(1 + draw(3)), {.key = "load"});
    const Vec2 start(place(random), place(random)), size(part(random), part(random));
    const FieldRange range(field);
    ASSERT_TRUE(range.known()) << field.words();
    const Interval all = range({{start.x(), start.x() + size.x()}, {start.y(), start.y() + size.y()}, {}});
    for (int i = 0; i < 20; ++i) {
      const double value = field(start + Vec2(part(random), part(random)).cwiseProduct(size));
      EXPECT_GE(value, all.low - 1e-9 * std::abs(value) - 1e-12) << field.words();
      EXPECT_LE(value, all.high + 1e-9 * std::abs(value) + 1e-12) << field.words();
    }
    Points nodes(3, 2);  // of a curved edge
    nodes << start.transpose(), (start + size).transpose(),
        (start + size / 2).transpose() + 0.2 * Vec2(part(random), part(random)).transpose();
    const LineFunction on_edge = along_edge(nodes, {3, {0, 1, 2}}, field, range, {});
    const double from = part(random) - 1, to = from + std::pow(10, -4 * part(random));
    const Interval piece = *on_edge.range(from, to);
    for (int i = 0; i < 20; ++i) {
      const double value = on_edge.at(from + (to - from) * part(random));
      EXPECT_GE(value, piece.low - 1e-9 * std::abs(value) - 1e-12) << field.words();
      EXPECT_LE(value, piece.high + 1e-9 * std::abs(value) + 1e-12) << field.words();
    }
  }
}

}  // namespace
}  // namespace mortise::test
