// Structured meshes of bodies that are images of a unit square, each with nodes of its own, without gmsh.
#pragma once

#include <functional>

#include "mesh/mesh.hpp"

namespace mortise::test {

/// A body: the image of [0, 1] x [0, 1] under `map`, which keeps the square's orientation. Its sides are the boundaries
/// NAME_south (second coordinate 0), NAME_east (first 1), NAME_north, NAME_west, and NAME_all of all four;
/// closed: the west side is the east side (a ring), and NAME_all is not there.
struct Patch {
  std::string name;
  int n, m;  ///< elements along the first and the second coordinate
  std::function<Vec2(double, double)> map;
  bool closed = false;
};

/// quad4 or quad8; middle nodes are images too.
Mesh mesh_of(const std::vector<Patch>& patches, CellKind kind);

/// Between the radii r0 (south) and r1 (north) round a centre, from one angle back to another, which is smaller.
Patch ring(const std::string& name, int n, int m, const Vec2& centre, double r0, double r1, double from, double to);

/// Between two heights over a <= x <= b.
Patch block(const std::string& name, int n, int m, double a, double b, std::function<double(double)> bottom,
            std::function<double(double)> top);

}  // namespace mortise::test
