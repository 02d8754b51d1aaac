#include "mesh/size_field.hpp"

#include <algorithm>
#include <limits>
#include <queue>

#include "base/vectors.hpp"

namespace mortise {
namespace {

// How deep outside the triangle x lies, in its own coordinates; 0 inside. `at`: the coordinates, cut off at the sides.
double outside(const std::array<Vec2, 3>& t, const Vec2& x, Eigen::Vector3d& at) {
  const double twice_area = cross(Vec2(t[1] - t[0]), Vec2(t[2] - t[0]));
  at = Eigen::Vector3d(cross(Vec2(t[1] - x), Vec2(t[2] - x)), cross(Vec2(t[2] - x), Vec2(t[0] - x)),
                       cross(Vec2(t[0] - x), Vec2(t[1] - x))) /
       twice_area;
  const double deepest = std::max(0.0, -at.minCoeff());
  at = at.cwiseMax(0);
  at /= at.sum();
  return deepest;
}

// With a margin for places between a chord and its curve.
template <typename Triangle>
std::vector<Box> boxes_of(const std::vector<Triangle>& triangles) {
  std::vector<Box> boxes;
  for (const Triangle& t : triangles) {
    Box box(t.x[0]);
    box.extend(t.x[1]).extend(t.x[2]);
    const Vec2 margin = Vec2::Constant(0.1 * box.sizes().norm());
    boxes.emplace_back(box.min() - margin, box.max() + margin);
  }
  return boxes;
}

}  // namespace

SizeField::SizeField(const Mesh& mesh, const VecX& sizes, std::vector<SizeLayers> layers)
    : SizeField(triangles_of(mesh, sizes), std::move(layers)) {}

SizeField::SizeField(std::vector<Triangle> triangles, std::vector<SizeLayers> layers)
    : triangles_(std::move(triangles)), layers_(std::move(layers)), boxes_(boxes_of(triangles_)) {}

std::vector<SizeField::Triangle> SizeField::triangles_of(const Mesh& mesh, const VecX& sizes) {
  std::vector<Triangle> triangles;
  for (const Cell& cell : mesh.cells)
    for (int k = 2; k < corner_count(cell.kind); ++k) {
      Triangle& t = triangles.emplace_back();
      for (int a = 0; a < 3; ++a) {
        const int node = cell.nodes[a == 0 ? 0 : k - 2 + a];
        t.x[a] = mesh.nodes.row(node);
        t.size[a] = sizes(node);
      }
    }
  return triangles;
}

double SizeField::operator()(const Vec2& x) const {
  constexpr double inside = 1e-6;  // in the triangle's own coordinates
  double size = std::numeric_limits<double>::infinity(), nearest = size, at_nearest = size;
  const auto look_at = [&](int number) {
    const Triangle& t = triangles_[number];
    Eigen::Vector3d at;
    const double depth = outside(t.x, x, at);
    const double value = at(0) * t.size[0] + at(1) * t.size[1] + at(2) * t.size[2];
    if (depth <= inside) size = std::min(size, value);
    if (depth < nearest) {
      nearest = depth;
      at_nearest = value;
    }
  };
  for (const int number : boxes_.meeting(Box(x))) look_at(number);
  constexpr int looked_at = 8;
  if (!std::isfinite(nearest))  // far outside
    for (const int number : boxes_.nearest(x, looked_at)) look_at(number);
  if (nearest > inside) size = at_nearest;
  return std::min(size, layers_(x));
}

void limit_growth(const Mesh& mesh, double growth, VecX& sizes) {
  struct Side {
    int to;
    double length;
  };
  std::vector<std::vector<Side>> sides(mesh.nodes.rows());
  for (const Cell& cell : mesh.cells) {
    const int corners = corner_count(cell.kind);
    for (int a = 0; a < corners; ++a) {
      const int i = cell.nodes[a], j = cell.nodes[(a + 1) % corners];
      const double length = (mesh.nodes.row(i) - mesh.nodes.row(j)).norm();
      sides[i].push_back({j, length});
      sides[j].push_back({i, length});
    }
  }
  // From the smallest on, each vertex once (Dijkstra).
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (int i = 0; i < int(sides.size()); ++i)
    if (!sides[i].empty()) queue.emplace(sizes(i), i);
  while (!queue.empty()) {
    const auto [size, i] = queue.top();
    queue.pop();
    if (size > sizes(i)) continue;
    for (const Side& side : sides[i]) {
      const double limit = size + growth * side.length;
      if (!(limit < sizes(side.to))) continue;
      sizes(side.to) = limit;
      queue.emplace(limit, side.to);
    }
  }
}

}  // namespace mortise
