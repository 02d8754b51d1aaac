// Sizes that grow away from places, looked up by branch and bound.
#include "mesh/layered_sizes.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace mortise {
namespace {

double least_of_all(const std::vector<SizeLayers>& layers, const Vec2& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const SizeLayers& l : layers) least = std::min(least, l.least + l.growth * (x - l.centre).norm());
  return least;
}

TEST(LayeredSizes, AreTheLeastOfAllLayers) {
  std::vector<SizeLayers> layers;
  for (int k = 0; k < 200; ++k) {
    const double angle = 2.4 * k;
    layers.push_back({std::sqrt(k) * Vec2(std::cos(angle), std::sin(angle)), 0.01 * (1 + k % 7), 0.2 + 0.1 * (k % 3)});
  }
  const LayeredSizes sizes(layers);
  for (int k = 0; k < 100; ++k) {
    const Vec2 x(0.3 * k - 15, 20 * std::sin(k));
    EXPECT_EQ(sizes(x), least_of_all(layers, x));
  }
  EXPECT_TRUE(std::isinf(LayeredSizes({})(Vec2::Zero())));
}

// Heaps of places of very different sizes, some in one place, some in line: no branch is left out that has the least.
TEST(LayeredSizes, AreTheLeastOfLayersDrawnAtRandom) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(0, 1);
  for (const int count : {1, 8, 9, 17, 300, 2000}) {
    std::vector<SizeLayers> layers;
    for (int k = 0; k < count; ++k) {
      const Vec2 heap(k % 5, k % 3);
      const double wide = std::pow(10, -6 * part(random));
      Vec2 centre = heap + wide * Vec2(part(random), part(random));
      if (k % 11 == 0) centre = heap;
      if (k % 13 == 0) centre.y() = 0;
      layers.push_back({centre, std::pow(10, -5 * part(random)), 0.1 + part(random)});
    }
    const LayeredSizes sizes(layers);
    for (int k = 0; k < 300; ++k) {
      const Vec2 x = k % 2 == 0 ? Vec2(8 * part(random) - 2, 8 * part(random) - 2)
                                : Vec2(layers[k % layers.size()].centre + 1e-4 * Vec2(part(random), part(random)));
      ASSERT_EQ(sizes(x), least_of_all(layers, x)) << count << " " << x.transpose();
    }
  }
}

}  // namespace
}  // namespace mortise
