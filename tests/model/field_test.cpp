#include "model/field.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <thread>

#include "support/messages.hpp"

namespace mortise::test {
namespace {

Field on_curve(const std::string& text) { return {text, {.key = "load", .on_curve = true}}; }

TEST(Field, ANumberIsItself) {
  const Field f = -2.5;
  EXPECT_TRUE(f.is_constant());
  EXPECT_FALSE(f.uses_arc_length());
  EXPECT_EQ(f(Vec2(3, 4), 5), -2.5);
  EXPECT_EQ(f.words(), "-2.5");
}

TEST(Field, AnExpressionIsAFunctionOfPlaceAndArcLength) {
  const Vec2 at(-3, 4);
  const double pi = std::numbers::pi;
  EXPECT_DOUBLE_EQ(on_curve("1e6 * (1 - x^2)")(at), -8e6);
  EXPECT_DOUBLE_EQ(on_curve("-x^2 + y")(at), -5);  // -(x^2)
  EXPECT_DOUBLE_EQ(on_curve("r * cos(theta)")(at), -3);
  EXPECT_DOUBLE_EQ(on_curve("theta / pi")(at), std::atan2(4, -3) / pi);
  EXPECT_DOUBLE_EQ(on_curve("s < 1 ? 2 : 3 * s")(at, 7), 21);
  EXPECT_DOUBLE_EQ(on_curve("x == -3 && y >= 4")(at), 1);
  EXPECT_TRUE(on_curve("sqrt(s)").uses_arc_length());
  EXPECT_FALSE(on_curve("x").uses_arc_length());
  EXPECT_EQ(on_curve(" x* y").words(), " x* y");
}

TEST(Field, EqualsOneOfTheSameNumberOrText) {
  EXPECT_EQ(Field(2), Field(2.0));
  EXPECT_EQ(on_curve("x"), on_curve("x"));
  EXPECT_FALSE(on_curve("x") == on_curve("y") || on_curve("0") == Field(0) || Field(0) == on_curve("0"));
}

TEST(Field, ConstantsAreTheirValues) {
  const FieldUse use{.key = "load", .constants = {{"c", -2.5}, {"e", 3}, {"c_2", 0.1}}};
  const Vec2 at(2, 0);
  EXPECT_DOUBLE_EQ(Field("c * x^e", use)(at), -20);
  EXPECT_DOUBLE_EQ(Field("2^c + x", use)(at), std::pow(2, -2.5) + 2);
  EXPECT_DOUBLE_EQ(Field("1e1*e+1.e1 *x+c_2", use)(at), 50.1);
  EXPECT_EQ(Field("c_2 * x", use).words(), "(0.10000000000000001) * x");
  FieldUse other = use;
  other.constants["c"] = -2;
  EXPECT_FALSE(Field("c * x", use) == Field("c * x", other));
  EXPECT_TRUE(Field("e * x", use) == Field("e * x", other));
  EXPECT_EQ(Field("c * e", use), Field(-7.5)) << "a number where nothing varies";
  try {
    Field("c * d", use);
    FAIL();
  } catch (const ExpressionError& error) {
    EXPECT_EQ(error.position, 4u);
    EXPECT_NE(std::string(error.what()).find("pi, c, c_2, e"), std::string::npos) << error.what();
  }
}

TEST(Field, SeveralThreadsMayAskTheSameOne) {
  const Field f = on_curve("sin(x) + s"), copy = f;
  std::vector<double> sums(4, 0);
  {
    std::vector<std::jthread> threads;
    for (std::size_t k = 0; k < sums.size(); ++k)
      threads.emplace_back([&, k] {
        for (int i = 0; i < 20000; ++i) sums[k] += std::abs((k % 2 ? f : copy)(Vec2(i, 0), k) - std::sin(i) - k);
      });
  }
  for (const double sum : sums) EXPECT_LT(sum, 1e-8);
}

struct Broken {
  std::string text, trouble;
  std::size_t position;
};

TEST(Field, TextThatIsNoExpressionSaysWhatAndWhere) {
  for (const auto& [text, trouble, position] : std::vector<Broken>{
           {"", "empty", 0},
           {"1e6 * (1 - z^2)", "unknown name 'z'; known: x, y, r, theta, s, pi", 11},
           {"x + thta", "did you mean 'theta'?", 4},
           {"foo(x)", "unknown name 'foo'", 0},
           {"2x", "unexpected variable \"x\"", 1},
           {"x^", "unexpected end of expression", 2},
           {"sin(x", "missing parenthesis", 5},
           {"sin()", "too few parameters", 4},
           {"x**2", "unexpected operator \"*\"", 2},
           {"x = 3", "assigns a value", 2},
           {"x <= y = 3", "assigns a value", 7},
           {"1,5", "has a comma", 1},
           {"\"a\"", "strings", 2},
           {"x\"", "unterminated string", 1},
           {"\xc3\xa9", "unexpected token", 0},
           {"1e400", "unexpected token", 0},
           {std::string(1001, ' ') + "x", "longer than 1000 characters", 1000},
       })
    try {
      on_curve(text);
      ADD_FAILURE() << text << " was taken";
    } catch (const ExpressionError& error) {
      EXPECT_NE(std::string(error.what()).find(trouble), std::string::npos) << text << ": " << error.what();
      EXPECT_NEAR(double(error.position), double(position), 1) << text;
    }
}

TEST(Field, KnowsTheArcLengthOnCurvesOnly) {
  EXPECT_EQ(message_of<ExpressionError>([] { Field("2 * s", {.key = "body"}); }),
            "s, the arc length, is known on curves only; known: x, y, r, theta, pi");
}

TEST(Field, AValueThatCannotBeNamesKeyAndPlace) {
  EXPECT_EQ(message_of<SceneError>([] { on_curve("1 / x")(Vec2(0, 0.3)); }),
            "load: '1 / x' is inf near (0, 0.3); expected a finite value");
  EXPECT_EQ(message_of<SceneError>([] { on_curve("sqrt(x)")(Vec2(-1, 0.3)); }),
            "load: 'sqrt(x)' is not a number near (-1, 0.3); expected a finite value");
  const Field small("x", {.key = "load", .largest = 2, .limit = "at most 2"});
  EXPECT_EQ(small(Vec2(-2, 0)), -2);
  EXPECT_EQ(message_of<SceneError>([&] { small(Vec2(-3, 0)); }), "load: 'x' is -3 near (-3, 0); expected at most 2");
}

}  // namespace
}  // namespace mortise::test
