// [[probe]] as a user writes it, and as one miswrites it.
#include <gtest/gtest.h>

#include "scene/scene_files.hpp"
#include "support/messages.hpp"

namespace mortise::test {
namespace {

Scene with(const std::string& probe) { return scene_with("\n[[probe]]\n" + probe); }

TEST(ReadProbes, OnePointSeveralAndALine) {
  const Scene one = with("at = [0.1, 0.2]\nbody = \"block\"\nangle = 30"), two = with("at = [[0, 1], [2, 3]]"),
              line = with("from = [0, 0]\nto = [1, 2]\npoints = 5");
  EXPECT_EQ(one.probes[0].at, std::vector<Vec2>{Vec2(0.1, 0.2)});
  EXPECT_EQ(one.probes[0].body, "block");
  EXPECT_EQ(one.probes[0].angle, 30);
  EXPECT_FALSE(one.probes[0].line);
  EXPECT_EQ(two.probes[0].at, (std::vector<Vec2>{Vec2(0, 1), Vec2(2, 3)}));
  ASSERT_EQ(line.probes[0].at.size(), 5u);
  EXPECT_TRUE(line.probes[0].line);
  EXPECT_EQ(line.probes[0].at[1], Vec2(0.25, 0.5));
  EXPECT_EQ(line.probes[0].at[4], Vec2(1, 2));
}

TEST(ReadProbes, MistakesAreNamed) {
  const auto expect = [](const std::string& probe, const std::string& part) {
    expect_contains(message_of([&] { with(probe); }), part);
  };
  expect("body = \"block\"", "expected");
  expect("at = [0, 1]\nfrom = [0, 0]", "probe.0");
  expect("at = [0, 1, 2]", "expected a list of two numbers [x, y]");
  expect("at = []", "expected a list of two numbers [x, y]");
  expect("at = [[0, 1], [2]]", "expected a list of two numbers [x, y]");
  expect("at = [0, nan]", "probe.0.at.1");
  expect("at = [0, 1]\npoints = 3", "probe.0.points: goes with 'from', along a line");
  expect("from = [0, 0]\npoints = 3", "where the line ends");
  expect("from = [0, 0]\nto = [1, 0]", "how many points the line has");
  expect("from = [0, 0]\nto = [1, 0]\npoints = 1", "probe.0.points");
  expect("from = [0, 0]\nto = [1, 0]\npoints = 2.5", "probe.0.points");
  expect("from = [1, 0]\nto = [1, 0]\npoints = 3", "the line has no length");
  expect("at = [0, 1]\nangel = 3", "did you mean 'angle'");
}

}  // namespace
}  // namespace mortise::test
