#include "mesh_files/assemble_mesh.hpp"

#include <gtest/gtest.h>

namespace mortise {
namespace {

/// A square of one cell whose curve "side" is of two blocks, the lower and the upper edge.
MeshData square_with_two_edges(bool lower_drawn, bool upper_drawn) {
  const auto drawn = [](bool is, const Vec2& from, const Vec2& to) {
    return is ? std::vector{EdgeSamples{{{1, {from, to}}}}} : std::vector<EdgeSamples>{};
  };
  return {.file = "a.msh",
          .nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
          .groups = {{2, 1, "body"}, {1, 2, "side"}},
          .blocks = {{2, 1, 3, {1}, {0, 1, 2, 3}},
                     {1, 1, 1, {2}, {0, 1}, drawn(lower_drawn, {0, 0}, {1, 0})},
                     {1, 2, 1, {2}, {2, 3}, drawn(upper_drawn, {1, 1}, {0, 1})}}};
}

TEST(AssembleMesh, ACurveIsDrawnAsAWholeOrNotAtAll) {
  for (const bool lower : {false, true})
    for (const bool upper : {false, true}) {
      const Mesh mesh = assemble_mesh(square_with_two_edges(lower, upper));
      EXPECT_EQ(mesh.boundaries.at(0).edges.size(), 2u);
      EXPECT_EQ(mesh.boundaries.at(0).samples.size(), lower && upper ? 2u : 0u) << lower << upper;
    }
}

}  // namespace
}  // namespace mortise
