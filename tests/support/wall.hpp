// A wall of n x n blocks with a contact pair wherever two of them meet: many bodies, without files.
#pragma once

#include "scene/scene.hpp"
#include "support/patches.hpp"

namespace mortise::test {

struct Wall {
  Mesh mesh;
  Scene scene;
};

/// Blocks of 1 / n, with `elements` or one more along each side in turn so that no two meshes match; clamped at the
/// bottom, between smooth walls, pressed on top, by one to three MPa from block to block. 2 n (n - 1) pairs, the one
/// between the blocks (i, j) and (i + 1, j) before that between (i, j) and (i, j + 1).
Wall wall(int n, int elements = 3);

}  // namespace mortise::test
