// Loads that come so near to the end of contact that no row of a first mesh is as near.
#include "app/short_edges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

#include "app/accuracy.hpp"
#include "support/audited_scenes.hpp"
#include "support/messages.hpp"

namespace mortise::test {
namespace {

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double between(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  double decades(double from, double to) { return std::pow(10, between(from, to)); }
  bool coin() { return between(0, 1) < 0.5; }

 private:
  std::mt19937 random_;
};

std::string rectangle(double x, double y, double width, double height) {
  std::ostringstream text;
  text.precision(17);
  text << x << ", " << y << ", 0, " << width << ", " << height;
  return text.str();
}

// A traction on a width about x whose resultant, `force` downwards, lies `from_end` inwards of its right end or its
// left one.
std::string eccentric(double force, double x, double width, double from_end, bool right) {
  const double e = (width / 2 - from_end) * (right ? 1 : -1);
  std::ostringstream text;
  text.precision(17);
  text << "traction = [0, \"" << -force / width << " * (1 + 12 * (" << e << ") * (x - (" << x << ")) / " << width
       << "^2)\"]";
  return text.str();
}

// Blocks that stand on a base, each loaded at 1e-4 to 1e-2 of its width from an end, so little that it moves by no more
// than it slides.
Scene blocks(const TemporaryFolder& folder, Draw& draw, int count, bool bulging) {
  std::vector<std::string> boxes{rectangle(-20, -20, 40, 20)}, bodies{"b1"};
  std::string rest = "[accuracy]\nvalue = 0.01\n" + held("down1");
  for (int i = 0; i < count; ++i) {
    const std::string n = std::to_string(i + 2);
    const double width = draw.between(2, 8), x = 13 * (i - (count - 1) / 2.), from_end = width * draw.decades(-4, -2);
    const double bulge = bulging ? draw.decades(-7, -6) * from_end : 0;
    boxes.push_back(rectangle(x - width / 2, 0, width, draw.between(3, 8)));
    bodies.push_back("b" + n);
    rest += boundary("up" + n, eccentric(0.01 * from_end, x, width, from_end, draw.coin()));
    rest += pair("down" + n, "up1");
    if (draw.coin()) rest += "multipliers_on = \"" + (draw.coin() ? "down" + n : std::string("up1")) + "\"\n";
    std::ostringstream clearance;
    clearance << "clearance = \"" << bulge << " * (1 - 4 * (x - (" << x << "))^2 / " << width << "^2)\"\n";
    if (bulging) rest += clearance.str();
  }
  return drawn(folder, "Mesh.MeshSizeMax = 1.5;\n" + rectangles(boxes), bodies, rest);
}

// A block upon a block, at one of its ends or within.
Scene stack(const TemporaryFolder& folder, Draw& draw) {
  const double low = draw.between(4, 10), high = draw.between(1, low), from_end = high * draw.decades(-4, -2);
  const double x = (low - high) / 2 * (draw.coin() ? 1 : draw.between(-1, 1));
  return drawn(folder,
               "Mesh.MeshSizeMax = 1.5;\n" + rectangles({rectangle(-20, -20, 40, 20), rectangle(-low / 2, 0, low, 4),
                                                         rectangle(x - high / 2, 4, high, 3)}),
               {"b1", "b2", "b3"},
               "[accuracy]\nvalue = 0.01\n" + held("down1") +
                   boundary("up3", eccentric(0.01 * from_end, x, high, from_end, true)) + pair("down2", "up1") +
                   pair("down3", "up2"));
}

void expect_meshed(const Scene& scene) {
  expect_contains(message_of([&] { solve_scene(scene); }),
                  "the load moves it away from the contact on this mesh; expected shorter edges where contact ends, "
                  "whose pressures would carry the load");
  const auto found = solve_to_accuracy(scene);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->accuracy->reached()) << found->accuracy->reason;
  EXPECT_EQ(found->status, Status::solved);
}

TEST(ShortEdges, AreMadeWhereBlocksAreLoadedNearTheirEnds) {
  const TemporaryFolder folder;
  Draw draw(1);
  for (int variant = 0; variant < 5; ++variant) {
    SCOPED_TRACE(variant);
    expect_meshed(blocks(folder, draw, 1 + variant % 3, false));
  }
}

TEST(ShortEdges, AreMadeWhereAGapBulgesBetweenTheEnds) {
  const TemporaryFolder folder;
  Draw draw(2);
  for (int variant = 0; variant < 4; ++variant) {
    SCOPED_TRACE(variant);
    expect_meshed(blocks(folder, draw, 1 + variant % 2, true));
  }
}

TEST(ShortEdges, AreMadeUnderABlockOnABlock) {
  const TemporaryFolder folder;
  Draw draw(3);
  for (int variant = 0; variant < 3; ++variant) {
    SCOPED_TRACE(variant);
    expect_meshed(stack(folder, draw));
  }
}

Scene eccentric_block(const TemporaryFolder& folder, double from_end) {
  return drawn(folder,
               "Mesh.MeshSizeMax = 1.5;\n" + rectangles({rectangle(-20, -20, 40, 20), rectangle(-5, 0, 10, 10)}),
               {"b1", "b2"},
               "[accuracy]\nvalue = 0.01\n" + held("down1") + boundary("up2", eccentric(1e-5, 0, 10, from_end, true)) +
                   pair("down2", "up1"));
}

// A case that no row of the first mesh carries is not left out beside one that all carry.
TEST(ShortEdges, AreMadeForAnyOfSeveralCases) {
  const TemporaryFolder folder;
  const Scene in_the_middle = eccentric_block(folder, 5);
  const Scene at_an_end = eccentric_block(folder, 0.005);
  const AccurateMesh found = mesh_to_accuracy({&in_the_middle, &at_an_end});
  EXPECT_TRUE(found.report.reached()) << found.report.reason;
  EXPECT_EQ(solve_scene(at_an_end, found.mesh).status, Status::solved);
}

// A pressure at the very end of contact would carry such a load, edges would not.
TEST(ShortEdges, AreNotAskedForWhereTheLoadLiesOnTheEnd) {
  const TemporaryFolder folder;
  for (const double from_end : {0.0, -0.01}) {
    const Scene scene = eccentric_block(folder, from_end);
    for (const std::string& text :
         {message_of([&] { solve_scene(scene); }), message_of([&] { solve_to_accuracy(scene); })})
      expect_contains(text, "the load moves it away from the contact; expected a load that presses it on");
  }
}

}  // namespace
}  // namespace mortise::test
