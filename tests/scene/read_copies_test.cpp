// Expected values: exact, from the scene text.
#include <gtest/gtest.h>

#include "scene/scene.hpp"
#include "scene_files.hpp"
#include "support/messages.hpp"

namespace mortise {
namespace {

class Copies : public testing::Test {
 protected:
  Copies() { folder_.write("block.msh", ""); }
  Scene read(const std::string& copies, const std::vector<Override>& overrides = {}) {
    return read_scene(folder_.write("scene.toml", test::shortest_scene + copies), overrides);
  }
  // After the place; the entry starts on a line of its own.
  std::string refusal(const std::string& keys) {
    const std::string text = test::message_of([&] { read("\n[[copies]]\n" + keys); });
    return text.substr(std::min(text.size(), text.find("copies.0")));
  }
  test::TemporaryFolder folder_;
};

TEST_F(Copies, ThereAreNoneWithoutASection) { EXPECT_TRUE(read("").copies.empty()); }

TEST_F(Copies, OfAGridStandRowByRow) {
  const Scene scene = read(R"(
[[copies]]
body = "block"
name = "block_*_*"
grid = { count = [3, 2], step = [2, 0.5], start = [10, 20], shift = -1 }
)");
  ASSERT_EQ(scene.copies.size(), 6u);
  for (int k = 0; k < 6; ++k) {
    const BodyCopy& copy = scene.copies[k];
    const int i = k % 3, j = k / 3;
    EXPECT_EQ(copy.key.find("copies.0 (line "), 0u);
    EXPECT_EQ(copy.body, "block");
    EXPECT_EQ(copy.name, "block_" + std::to_string(i) + "_" + std::to_string(j));
    EXPECT_EQ(copy.degrees, 0);
    EXPECT_EQ(copy.shift, Vec2(10 + 2 * i - j, 20 + 0.5 * j));
  }
}

TEST_F(Copies, OfSeveralBodiesTakeTurns) {
  const Scene scene = read(R"(
[[copies]]
body = ["a", "b"]
name = "x*y"
grid = { count = [2, 2], step = [1, 1] }
[[copies]]
body = ["a", "b", "c"]
name = "z*"
places = [[0, 0], [1, 0], [2, 0], [3, 0]]
)");
  std::vector<std::pair<std::string, std::string>> names;
  for (const BodyCopy& copy : scene.copies) names.emplace_back(copy.name, copy.body);
  EXPECT_EQ(names, (std::vector<std::pair<std::string, std::string>>{{"x0_0y", "a"},
                                                                     {"x1_0y", "b"},
                                                                     {"x0_1y", "b"},
                                                                     {"x1_1y", "a"},
                                                                     {"z0", "a"},
                                                                     {"z1", "b"},
                                                                     {"z2", "c"},
                                                                     {"z3", "a"}}));
}

TEST_F(Copies, OfAListMayBeTurned) {
  const Scene scene = read(R"(
[[copies]]
body = "block"
name = "stone_*"
centre = [0.5, 0.25]
places = [[1, 2], [3, 4, -30]]
[[copies]]
body = "foot"
name = "left_foot"
places = [[-1, 0]]
)");
  ASSERT_EQ(scene.copies.size(), 3u);
  EXPECT_EQ(scene.copies[0].shift, Vec2(1, 2));
  EXPECT_EQ(scene.copies[0].degrees, 0);
  EXPECT_EQ(scene.copies[1].name, "stone_1");
  EXPECT_EQ(scene.copies[1].shift, Vec2(3, 4));
  EXPECT_EQ(scene.copies[1].degrees, -30);
  EXPECT_EQ(scene.copies[1].centre, Vec2(0.5, 0.25));
  EXPECT_EQ(scene.copies[2].name, "left_foot");
}

TEST_F(Copies, OfARingAreTurnedByTheSamePartOfATurn) {
  const Scene scene = read(R"(
[[copies]]
body = "roller"
name = "roller_*"
centre = [0, 1]
ring = 8
)");
  ASSERT_EQ(scene.copies.size(), 8u);
  for (int k = 0; k < 8; ++k) {
    EXPECT_EQ(scene.copies[k].name, "roller_" + std::to_string(k));
    EXPECT_EQ(scene.copies[k].degrees, 45 * k);
    EXPECT_EQ(scene.copies[k].centre, Vec2(0, 1));
    EXPECT_EQ(scene.copies[k].shift, Vec2(0, 0));
  }
}

TEST_F(Copies, AreChangedFromTheCommandLine) {
  const std::string grid = "\n[[copies]]\nbody = \"block\"\nname = \"b*\"\ngrid = { count = [2, 1], step = [1, 1] }\n";
  EXPECT_EQ(read(grid, {{"copies.0.grid.count", "[5, 3]"}}).copies.size(), 15u);
}

TEST_F(Copies, AreRefusedInWordsThatSayWhatIsExpected) {
  const std::string body = "body = \"block\"\n", name = "name = \"b_*\"\n",
                    grid = "grid = { count = [2, 3], step = [1, 1] }\n";
  EXPECT_EQ(refusal(name + grid).find("copies.0: 'body' is missing; expected a body of the mesh"), 0u);
  EXPECT_EQ(refusal(body + grid).find("copies.0: 'name' is missing; expected the names of the copies"), 0u);
  EXPECT_EQ(refusal(body + name), "copies.0: expected exactly one of 'grid', 'places', 'ring', found none");
  EXPECT_EQ(refusal(body + name + grid + "ring = 3").find("copies.0: 'grid' and 'ring' exclude each other"), 0u);
  EXPECT_EQ(refusal(body + name + "gird = 3").find("copies.0: unknown key 'gird'; did you mean 'grid'?"), 0u);
  EXPECT_EQ(refusal(body + name + "grid = { count = [2, 0.5], step = [1, 1] }"),
            "copies.0.grid.count.1: expected a whole number from 1 to 500000, found 0.5");
  EXPECT_EQ(refusal(body + name + "grid = { count = [0, 2], step = [1, 1] }"),
            "copies.0.grid.count.0: expected a whole number from 1 to 1000000, found 0");
  EXPECT_EQ(
      refusal(body + name + "grid = { count = [2, 2], step = [1, 0] }").find("copies.0.grid.step.1: expected a step"),
      0u);
  EXPECT_EQ(refusal(body + name + "places = []").find("copies.0.places: expected a list of places"), 0u);
  EXPECT_EQ(refusal(body + name + "places = [[1, 2], [1]]"),
            "copies.0.places.1: expected [x, y] or [x, y, degrees], found [1]");
  EXPECT_EQ(refusal(body + name + "ring = 1"), "copies.0.ring: expected a whole number from 2 to 1000000, found 1");
  EXPECT_EQ(refusal(body + name + grid + "centre = [0, 0]").find("copies.0.centre: goes with places = "), 0u);
  EXPECT_EQ(refusal(body + "name = \"b\"\n" + grid),
            "copies.0.name: expected a name with * for the number of the copy, such as \"block_*\" or \"block_*_*\", "
            "found 'b'");
  EXPECT_EQ(refusal(body + "name = \"b_*_*\"\nring = 3").find("copies.0.name: expected a name with *"), 0u);
  EXPECT_EQ(refusal(body + "name = 'b\"*'\nring = 3").find("copies.0.name: expected one line of text"), 0u);
}

}  // namespace
}  // namespace mortise
