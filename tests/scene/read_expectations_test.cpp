// [[expect]] as a user writes it, and as one miswrites it.
#include <gtest/gtest.h>

#include "scene/scene_files.hpp"
#include "support/messages.hpp"

namespace mortise::test {
namespace {

Scene expecting(const std::string& expectation) { return scene_with("\n[[expect]]\n" + expectation); }

TEST(ReadExpectations, FiguresAndPressures) {
  const Expectation figure =
      expecting("figure = \"energy\"\nvalue = 3\ntolerance = \"1%\"\nsource = \"a book\"").expectations[0];
  EXPECT_EQ(figure.figure, "energy");
  EXPECT_EQ(figure.value.constant(), 3);
  EXPECT_DOUBLE_EQ(figure.tolerance, 0.01);
  EXPECT_EQ(figure.source, "a book");
  const Expectation pressure = expecting("pressure = \"2 * x\"\npair = 1\ntolerance = 0.02").expectations[0];
  EXPECT_TRUE(pressure.figure.empty());
  EXPECT_EQ(pressure.value(Vec2(4, 0)), 8);
  EXPECT_EQ(pressure.pair, 1);
}

TEST(ReadExpectations, Miswritten) {
  const auto expect = [](const std::string& text, const std::string& part) {
    expect_contains(message_of([&] { expecting(text); }), part);
  };
  expect("tolerance = 0.1", "expect.0");
  expect("figure = \"energy\"\nvalue = 1", "expect.0");
  expect("figure = \"energy\"\ntolerance = 0.1", "expect.0");
  expect("figure = \"energy\"\nvalue = 0\ntolerance = 0.1", "no part of 0 is a tolerance");
  expect("figure = \"energy\"\nvalue = 1\npair = 0\ntolerance = 0.1", "goes with 'pressure'; a figure names");
  expect("figure = \"energy\"\npressure = 1\nvalue = 1\ntolerance = 0.1", "expect.0");
  expect("pressure = 1\nvalue = 1\ntolerance = 0.1", "goes with 'figure'; 'pressure' is a value itself");
  expect("pressure = \"2 *\"\ntolerance = 0.1", "expect.0.pressure");
  expect("pressure = 1\ntolerance = 2", "a part above 0 and below 1");
}

}  // namespace
}  // namespace mortise::test
